#include "cli/manual.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "experiments/output/quoting.h"

namespace gsp::cli {

namespace {

/// What of an option help and completion tell.
struct Entry {
  std::vector<std::string> names;  ///< "--output", "-o"; none of a place
  std::string place;               ///< what a place without a dash is called
  std::string value;               ///< "WORD"; empty for a flag
  std::string text;
  std::vector<std::string> words;  ///< all values there are, where they are words
};

struct Page {
  std::string name, text, group, footer;
  std::vector<Entry> entries;
};

/// The words after the default in "... [gsp; gsp, maps]", as `Command::choice` writes them.
std::vector<std::string> words_of(const std::string& text) {
  const std::size_t open = text.rfind('['), semicolon = text.rfind("; ");
  if (text.empty() || text.back() != ']' || open == std::string::npos || semicolon == std::string::npos ||
      semicolon < open)
    return {};
  std::vector<std::string> words = CLI::detail::split(text.substr(semicolon + 2, text.size() - semicolon - 3), ',');
  for (std::string& word : words) CLI::detail::trim(word);
  return words;
}

std::vector<Entry> entries_of(const CLI::App& app) {
  std::vector<Entry> entries;
  for (const CLI::Option* option : app.get_options()) {
    Entry entry;
    for (const std::string& name : option->get_snames()) entry.names.push_back("-" + name);
    for (const std::string& name : option->get_lnames()) entry.names.push_back("--" + name);
    if (entry.names.empty()) entry.place = option->get_name();
    entry.text = option->get_description();
    if (option->get_type_size() > 0) entry.value = option->get_option_text();
    if (entry.value.starts_with("WORD")) entry.words = words_of(entry.text);
    entries.push_back(std::move(entry));
  }
  return entries;
}

Page page_of(const CLI::App& app) {
  return {app.get_name(), app.get_description(), app.get_group(), app.get_footer(), entries_of(app)};
}

std::vector<Page> command_pages(const CLI::App& app) {
  std::vector<Page> pages;
  for (const CLI::App* command : app.get_subcommands({}))
    if (!command->get_group().empty()) pages.push_back(page_of(*command));
  return pages;
}

/// Text as roff has it: hyphens that are typed, no line that is a request.
std::string roff(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool starts_line = i == 0 || text[i - 1] == '\n';
    if (starts_line && (text[i] == '.' || text[i] == '\'')) result += "\\&";
    if (text[i] == '-') {
      result += "\\-";
    } else if (text[i] == '\\') {
      result += "\\e";
    } else {
      result += text[i];
    }
  }
  return result;
}

std::string roff_entry(const Entry& entry) {
  std::string head;
  for (const std::string& name : entry.names) head += (head.empty() ? "\\fB" : ", \\fB") + roff(name) + "\\fR";
  if (head.empty()) head = "\\fI" + roff(entry.place) + "\\fR";
  if (!entry.names.empty() && !entry.value.empty()) head += " \\fI" + roff(entry.value) + "\\fR";
  return ".TP\n" + head + "\n" + roff(entry.text) + "\n";
}

std::string man_page(const std::string& name, const Page& page, const std::string& synopsis, const std::string& more) {
  std::string text = fmt::format(".TH {} 1\n.SH NAME\n{} \\- {}\n.SH SYNOPSIS\n{}\n", roff(name), roff(name),
                                 roff(page.text), synopsis);
  text += ".SH OPTIONS\n";
  for (const Entry& entry : page.entries) text += roff_entry(entry);
  text += more;
  if (!page.footer.empty()) text += ".SH NOTES\n" + roff(page.footer) + "\n";
  return text;
}

std::string program_page(const Page& program, const std::vector<Page>& commands) {
  std::string list = ".SH COMMANDS\n", group;
  for (const Page& command : commands) {
    if (command.group != group) list += ".SS " + roff(command.group) + "\n";
    group = command.group;
    list += fmt::format(".TP\n\\fBgsp\\-{}\\fR(1)\n{}\n", roff(command.name), roff(command.text));
  }
  return man_page("gsp", program, "\\fBgsp\\fR \\fICOMMAND\\fR [\\fIOPTION\\fR]...", list);
}

std::string command_page(const Page& command) {
  std::string synopsis = fmt::format("\\fBgsp {}\\fR [\\fIOPTION\\fR]...", roff(command.name));
  for (const Entry& entry : command.entries)
    if (entry.names.empty()) synopsis += " \\fI" + roff(entry.place) + "\\fR";
  return man_page("gsp-" + command.name, command, synopsis, ".SH SEE ALSO\n\\fBgsp\\fR(1)\n");
}

std::string names_of(const Page& page) {
  std::vector<std::string> names;
  for (const Entry& entry : page.entries)
    for (const std::string& name : entry.names)
      if (name.starts_with("--")) names.push_back(name);
  return fmt::format("{}", fmt::join(names, " "));
}

std::string bash_completion(const Page& program, const std::vector<Page>& commands) {
  std::string names, options, words;
  for (const Page& command : commands) {
    names += " " + command.name;
    options += fmt::format("    {}) options={} ;;\n", command.name, shell_word(names_of(command)));
    for (const Entry& entry : command.entries)
      if (!entry.words.empty())
        words += fmt::format("    {}:{}) words={} ;;\n", command.name, entry.names.back(),
                             shell_word(fmt::format("{}", fmt::join(entry.words, " "))));
  }
  return fmt::format(
      "# bash completion of gsp, written by gsp itself\n"
      "_gsp() {{\n"
      "  local current=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} options='' words=''\n"
      "  COMPREPLY=()\n"
      "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
      "    COMPREPLY=($(compgen -W {} -- \"$current\"))\n"
      "    return\n"
      "  fi\n"
      "  case ${{COMP_WORDS[1]}}:$before in\n{}  esac\n"
      "  if [ -n \"$words\" ]; then\n"
      "    COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n"
      "    return\n"
      "  fi\n"
      "  case ${{COMP_WORDS[1]}} in\n{}  esac\n"
      "  case $current in\n"
      "    -*) COMPREPLY=($(compgen -W \"$options\" -- \"$current\")) ;;\n"
      "    *) COMPREPLY=($(compgen -f -- \"$current\")) ;;\n"
      "  esac\n"
      "}}\n"
      "complete -o filenames -F _gsp gsp\n",
      shell_word(names.substr(1) + " " + names_of(program)), words, options);
}

/// One option as zsh's _arguments has it.
std::string zsh_argument(const Entry& entry, const std::string& name) {
  std::string text = entry.text;
  for (const char special : {'[', ']', ':'}) text = CLI::detail::find_and_replace(text, std::string(1, special), " ");
  std::string argument = name + "[" + text + "]";
  if (!entry.words.empty())
    argument += fmt::format(":word:({})", fmt::join(entry.words, " "));
  else if (!entry.value.empty())
    argument += ":value:_files";
  return shell_word(argument);
}

std::string zsh_completion(const std::vector<Page>& commands) {
  std::string list, cases;
  for (const Page& command : commands) {
    list += "    " + shell_word(command.name + ":" + command.text) + "\n";
    cases += "    " + command.name + ") _arguments";
    for (const Entry& entry : command.entries)
      for (const std::string& name : entry.names) cases += " \\\n      " + zsh_argument(entry, name);
    cases += " \\\n      '*:file:_files' ;;\n";
  }
  return fmt::format(
      "#compdef gsp\n# written by gsp itself\n"
      "local -a commands\ncommands=(\n{})\n"
      "if (( CURRENT == 2 )); then\n  _describe command commands\n"
      "else\n  local command=$words[2]\n  shift words\n  (( CURRENT-- ))\n  case $command in\n{}  esac\nfi\n",
      list, cases);
}

std::string fish_completion(const std::vector<Page>& commands) {
  std::string text = "# fish completion of gsp, written by gsp itself\n";
  const auto fish = [](const std::string& plain) {
    return "'" + CLI::detail::find_and_replace(CLI::detail::find_and_replace(plain, "\\", "\\\\"), "'", "\\'") + "'";
  };
  for (const Page& command : commands) {
    text += fmt::format("complete -c gsp -f -n __fish_use_subcommand -a {} -d {}\n", command.name, fish(command.text));
    for (const Entry& entry : command.entries) {
      if (entry.names.empty()) continue;
      text += fmt::format("complete -c gsp -n '__fish_seen_subcommand_from {}'", command.name);
      for (const std::string& name : entry.names)
        text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
      if (!entry.words.empty())
        text += fmt::format(" -x -a {}", fish(fmt::format("{}", fmt::join(entry.words, " "))));
      else if (!entry.value.empty())
        text += " -r";
      text += " -d " + fish(entry.text) + "\n";
    }
  }
  return text;
}

}  // namespace

std::vector<ManualFile> manual(const CLI::App& app) {
  const Page program = page_of(app);
  const std::vector<Page> commands = command_pages(app);
  std::vector<ManualFile> files = {
      {"man/man1/gsp.1", program_page(program, commands)},
      {"bash-completion/completions/gsp", bash_completion(program, commands)},
      {"zsh/site-functions/_gsp", zsh_completion(commands)},
      {"fish/vendor_completions.d/gsp.fish", fish_completion(commands)},
  };
  for (const Page& command : commands) files.push_back({"man/man1/gsp-" + command.name + ".1", command_page(command)});
  return files;
}

}  // namespace gsp::cli

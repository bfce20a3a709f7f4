#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>

#include "cli.h"
#include "experiments/cells/suggest.h"
#include "temporary_folder.h"

namespace {

const std::vector<std::string> kCommands = {"info",       "parameterize", "remesh",  "encode", "decode", "distance",
                                            "distortion", "curve",        "picture", "report", "play"};

std::string text_of(const std::string& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

TEST_CASE("help goes to standard output with status 0, and names every command") {
  const Ran ran = gsp_run({"--help"});
  CHECK(ran.status == 0);
  CHECK(ran.err.empty());
  for (const std::string& command : kCommands) CHECK(contains(ran.out, command));
}

TEST_CASE("the help of every command gives the default and range of every option with a value") {
  for (const std::string& command : kCommands) {
    CAPTURE(command);
    const Ran ran = gsp_run({command, "--help"});
    CHECK(ran.status == 0);
    CHECK(contains(ran.out, "--threads"));
    std::istringstream lines(ran.out);
    std::string line, entry;
    const auto check_entry = [&] {
      if (entry.rfind("  -", 0) != 0) return;
      CAPTURE(entry);
      const bool flag = contains(entry, "--help") || contains(entry, "--json") || contains(entry, "--quiet") ||
                        contains(entry, "--verbose") || contains(entry, "--check ") ||
                        contains(entry, "--no-anchors") || contains(entry, "--no-figures") ||
                        contains(entry, "--metro ") || contains(entry, "--mpeg ") || contains(entry, "--profile ") ||
                        contains(entry, "--levels ") || contains(entry, "--stored-surfaces ");
      CHECK((flag || contains(entry, "[") || contains(entry, "(required)")));
    };
    while (std::getline(lines, line)) {
      if (line.rfind("  -", 0) == 0 || line.empty()) {
        check_entry();
        entry.clear();
      }
      entry += line + ' ';
    }
    check_entry();
  }
}

TEST_CASE("the version is one line on standard output") {
  const Ran ran = gsp_run({"--version"});
  CHECK(ran.status == 0);
  CHECK(ran.out.rfind("gsp 0.", 0) == 0);
}

TEST_CASE("wrong usage has status 2, a reason on standard error and no data") {
  const std::vector<std::vector<std::string>> wrong = {
      {},
      {"--threads", "1"},
      {"transmogrify"},
      {"info"},
      {"info", "a.ply", "b.ply"},
      {"info", "a.ply", "--threads", "-1"},
      {"info", "a.ply", "--threads", "x"},
      {"parameterize", "a.ply"},
      {"parameterize", "a.ply", "-o", "b", "--gamma", "-1"},
      {"parameterize", "a.ply", "-o", "b", "--gamma", "nan"},
      {"parameterize", "a.ply", "-o", "b", "--gamma", "inf"},
      {"parameterize", "a.ply", "-o", "b", "--base-vertices", "3"},
      {"parameterize", "a.ply", "-o", "b", "--base-vertices", "many"},
      {"parameterize", "a.ply", "-o", "b", "--base-vertices", "99999999999"},
      {"parameterize", "a.ply", "-o", "b", "--method", "magic"},
      {"remesh", "a", "-o", "b", "--level", "11"},
      {"remesh", "a", "-o", "b", "--level", "2", "--max-error", "0.1"},
      {"remesh", "a", "-o", "b", "--kind", "normal-ish"},
      {"encode", "a", "-o", "b", "--tangential-ratio", "3"},
      {"encode", "a", "-o", "b", "--bytes", "100", "--psnr", "50"},
      {"encode", "a", "-o", "b", "--bytes", "-5"},
      {"decode", "a"},
      {"distance", "a"},
      {"distance", "a", "b", "--samples", "1"},
      {"picture", "a.ply"},
      {"picture", "a.ply", "-o", "p.png", "--what", "magic"},
      {"picture", "a.ply", "-o", "p.png", "--view", "0,0,0"},
      {"picture", "a.ply", "-o", "p.png", "--up", "1,nan,0"},
      {"picture", "a.ply", "-o", "p.png", "--size", "15"},
      {"report", "a"},
      {"report", "a", "-o", "b", "--views", "-1"},
      {"curve", "a.ply"},
      {"curve", "-o", "d"},
      {"curve", "a.ply", "-o", "d", "--budgets", "100,0"},
      {"curve", "a.ply", "-o", "d", "--methods", "gsp,magic"},
  };
  for (const auto& args : wrong) {
    std::string line;
    for (const std::string& arg : args) line += arg + ' ';
    CAPTURE(line);
    const Ran ran = gsp_run(args);
    CAPTURE(ran.err);
    CHECK(ran.status == 2);
    CHECK(ran.out.empty());
    CHECK(ran.err.rfind("gsp: ", 0) == 0);
  }
}

TEST_CASE("a mistyped word is answered with the one that was probably meant") {
  CHECK(contains(gsp_run({"paramterize", "a.ply", "-o", "b"}).err, "did you mean parameterize?"));
  CHECK(contains(gsp_run({"parameterize", "a.ply", "-o", "b", "--base-vertcies", "100"}).err,
                 "unknown option --base-vertcies; did you mean --base-vertices?"));
  CHECK(contains(gsp_run({"parameterize", "a.ply", "--ouptut=b"}).err, "did you mean --output?"));
  CHECK(contains(gsp_run({"curve", "a.ply", "-o", "d", "--sampels", "5000"}).err, "did you mean --samples?"));
  const Ran nonsense = gsp_run({"info", "a.ply", "--zzzzzzzz"});
  CHECK(nonsense.status == 2);
  CHECK_FALSE(contains(nonsense.err, "did you mean"));
}

TEST_CASE("edit distance counts insertions, deletions, substitutions and swaps") {
  using gsp::edit_distance;
  CHECK(edit_distance("", "") == 0);
  CHECK(edit_distance("abc", "abc") == 0);
  CHECK(edit_distance("abc", "") == 3);
  CHECK(edit_distance("kitten", "sitting") == 3);
  CHECK(edit_distance("levle", "level") == 1);
  CHECK(edit_distance("--bytes", "--byte") == 1);
}

TEST_CASE("man pages and completions hold every option of every command") {
  const TemporaryFolder folder;
  CHECK(gsp_run({"manual", folder.file("share")}).status == 0);
  const std::string bash = text_of(folder.file("share/bash-completion/completions/gsp"));
  const std::string zsh = text_of(folder.file("share/zsh/site-functions/_gsp"));
  const std::string fish = text_of(folder.file("share/fish/vendor_completions.d/gsp.fish"));
  const std::regex name("--([a-z][a-z-]*)");
  for (const std::string& command : kCommands) {
    CAPTURE(command);
    const std::string page = text_of(folder.file("share/man/man1/gsp-" + command + ".1"));
    std::istringstream lines(gsp_run({command, "--help"}).out);
    for (std::string line; std::getline(lines, line);) {
      const std::string head = line.substr(0, 28);
      std::smatch match;
      if (line.rfind("  -", 0) != 0 || !std::regex_search(head, match, name)) continue;
      const std::string option = match[1];
      CAPTURE(option);
      CHECK(contains(page, std::regex_replace("--" + option, std::regex("-"), "\\-")));
      CHECK(contains(bash, "--" + option));
      CHECK(contains(zsh, "'--" + option));
      CHECK(contains(fish, "from " + command + "'"));
      CHECK(contains(fish, "-l " + option));
    }
  }
  CHECK(contains(text_of(folder.file("share/man/man1/gsp.1")), "Step by step"));
  const std::string completed = folder.file("completed");
  const std::string script = "source " + (folder.file("share/bash-completion/completions/gsp")) +
                             "; COMP_WORDS=(gsp remesh --kind n); COMP_CWORD=3; _gsp; echo \"${COMPREPLY[*]}\" >" +
                             completed;
  CHECK(std::system(("bash -c '" + script + "'").c_str()) == 0);
  CHECK(text_of(completed) == "normal\n");
}

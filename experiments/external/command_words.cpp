#include "experiments/external/command_words.h"

#include "mesh/error.h"

namespace gsp {

namespace {

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> words;
  bool inside = false;  // a word
  char quote = 0;
  const auto add = [&](char c) {
    if (!inside) words.emplace_back();
    inside = true;
    words.back() += c;
  };
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    const bool last = i + 1 == line.size();
    if (c == '\\' && quote != '\'' && !last && (!quote || line[i + 1] == '"' || line[i + 1] == '\\')) {
      add(line[++i]);
    } else if (quote ? c == quote : c == '\'' || c == '"') {
      quote = quote ? 0 : c;
      if (!inside) words.emplace_back();
      inside = true;
    } else if (!quote && (c == ' ' || c == '\t' || c == '\n')) {
      inside = false;
    } else {
      add(c);
    }
  }
  if (quote) throw Error(Cause::BadOption, "the quote " + std::string(1, quote) + " stays open in: " + line);
  if (words.empty()) throw Error(Cause::BadOption, "an empty command");
  return words;
}

std::string filled(const std::string& word, const std::map<std::string, std::string>& values) {
  std::string result;
  for (std::size_t at = 0; at < word.size();) {
    const std::size_t open = word.find('{', at), close = word.find('}', open);
    if (close == std::string::npos) return result + word.substr(at);
    const std::string name = word.substr(open + 1, close - open - 1);
    const auto value = values.find(name);
    if (value == values.end()) throw Error(Cause::BadOption, "{" + name + "} stands for nothing in a command");
    result += word.substr(at, open - at) + value->second;
    at = close + 1;
  }
  return result;
}

}  // namespace

std::vector<std::string> command_words(const std::string& line, const std::map<std::string, std::string>& values) {
  std::vector<std::string> words = split(line);
  for (std::string& word : words) word = filled(word, values);
  return words;
}

}  // namespace gsp

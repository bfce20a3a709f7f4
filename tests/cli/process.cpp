#include "process.h"

#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <iterator>

Ran gsp_process(const std::string& arguments, const TemporaryFolder& folder, const std::string& before) {
  const std::string out = folder.file("out.txt"), err = folder.file("err.txt");
  const std::string line = before + " timeout 60 '" GSP_PROGRAM "' " + arguments + " >'" + out + "' 2>'" + err + "'";
  const int status = std::system(line.c_str());
  const auto text = [](const std::string& path) {
    std::ifstream in(path);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text(out), text(err)};
}

std::string address_space([[maybe_unused]] int kb) {
#ifdef __SANITIZE_ADDRESS__
  return {};
#else
  return "ulimit -v " + std::to_string(kb) + ";";
#endif
}

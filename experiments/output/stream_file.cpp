#include "experiments/output/stream_file.h"

#include "mesh/atomic_file.h"
#include "mesh/read_file.h"

namespace gsp {

Bytes read_stream(const std::string& path) {
  const std::string bytes = read_file(path);
  return {bytes.begin(), bytes.end()};
}

void write_stream(const std::string& path, const Bytes& stream) {
  write_file(path, {reinterpret_cast<const char*>(stream.data()), stream.size()});
}

}  // namespace gsp

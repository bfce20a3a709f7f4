#include <bit>
#include <cstdint>
#include <ostream>

#include "mesh/ply.h"

namespace gsp {

namespace {

const char* type_name(PlyType type) {
  switch (type) {
    case PlyType::Int8:
      return "char";
    case PlyType::Uint8:
      return "uchar";
    case PlyType::Int16:
      return "short";
    case PlyType::Uint16:
      return "ushort";
    case PlyType::Int32:
      return "int";
    case PlyType::Uint32:
      return "uint";
    case PlyType::Float32:
      return "float";
    case PlyType::Float64:
      return "double";
  }
  return "";
}

/// Collects bytes and hands them to the stream in large pieces: a stream call per value would dominate the time.
class ByteWriter {
 public:
  explicit ByteWriter(std::ostream& out) : out_(out) { buffer_.reserve(2 * kPiece); }
  ~ByteWriter() { flush(); }
  ByteWriter(const ByteWriter&) = delete;
  ByteWriter& operator=(const ByteWriter&) = delete;

  void value(PlyType type, double value) {
    switch (type) {
      case PlyType::Int8:
        return put(static_cast<std::int8_t>(value));
      case PlyType::Uint8:
        return put(static_cast<std::uint8_t>(value));
      case PlyType::Int16:
        return put(static_cast<std::int16_t>(value));
      case PlyType::Uint16:
        return put(static_cast<std::uint16_t>(value));
      case PlyType::Int32:
        return put(static_cast<std::int32_t>(value));
      case PlyType::Uint32:
        return put(static_cast<std::uint32_t>(value));
      case PlyType::Float32:
        return put(static_cast<float>(value));
      case PlyType::Float64:
        return put(value);
    }
  }

 private:
  static constexpr std::size_t kPiece = 1 << 16;

  template <typename T>
  void put(T value) {
    static_assert(std::endian::native == std::endian::little);
    buffer_.append(reinterpret_cast<const char*>(&value), sizeof value);
    if (buffer_.size() >= kPiece) flush();
  }
  void flush() {
    out_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    buffer_.clear();
  }

  std::ostream& out_;
  std::string buffer_;
};

void write_header(std::ostream& out, const PlyDocument& document) {
  out << "ply\nformat binary_little_endian 1.0\n";
  for (std::string comment : document.comments) {
    for (char& c : comment)
      if (c == '\n' || c == '\r') c = ' ';
    out << "comment " << comment << '\n';
  }
  for (const PlyElement& element : document.elements) {
    out << "element " << element.name << ' ' << element.count << '\n';
    for (const PlyProperty& p : element.properties) {
      out << "property ";
      if (p.is_list()) out << "list " << type_name(*p.count_type) << ' ';
      out << type_name(p.type) << ' ' << p.name << '\n';
    }
  }
  out << "end_header\n";
}

}  // namespace

void write_ply(std::ostream& out, const PlyDocument& document) {
  write_header(out, document);
  ByteWriter bytes(out);
  for (const PlyElement& element : document.elements)
    for (std::size_t row = 0; row < element.count; ++row)
      for (const PlyProperty& p : element.properties) {
        if (!p.is_list()) {
          bytes.value(p.type, p.values[row]);
          continue;
        }
        bytes.value(*p.count_type, static_cast<double>(p.starts[row + 1] - p.starts[row]));
        for (std::size_t i = p.starts[row]; i < p.starts[row + 1]; ++i) bytes.value(p.type, p.values[i]);
      }
}

}  // namespace gsp

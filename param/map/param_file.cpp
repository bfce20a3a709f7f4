#include "param/map/param_file.h"

#include <bit>
#include <charconv>
#include <climits>
#include <cstring>
#include <fstream>
#include <limits>
#include <string_view>

#include "mesh/atomic_file.h"
#include "mesh/error.h"

namespace gsp {

namespace {

static_assert(std::endian::native == std::endian::little, "the file is little-endian and written as it lies in memory");

constexpr const char* kSignature = "gsp parameterization 1";

/// The elements in file order: how the header declares them and how many bytes one item takes. The last, creases, is
/// declared where there are any.
struct ElementLayout {
  const char* name;
  std::vector<const char*> properties;
  std::size_t bytes;
};

constexpr int kElements = 5, kCrease = 4;

const std::array<ElementLayout, kElements>& layout() {
  static const std::array<ElementLayout, kElements> kLayout = {{
      {"vertex", {"double x", "double y", "double z", "int patch", "double u", "double v"}, 5 * 8 + 4},
      {"face", {"list uchar int vertex_indices", "int chart", "list uchar double texcoord"}, 1 + 3 * 4 + 4 + 1 + 6 * 8},
      {"base_vertex", {"int vertex"}, 4},
      {"base_face", {"list uchar int base_vertex_indices"}, 1 + 3 * 4},
      {"crease", {"int first", "int second"}, 2 * 4},
  }};
  return kLayout;
}

/// Items appended to a buffer as they lie in memory.
class Output {
 public:
  template <class T>
  void put(T value) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    buffer_.append(bytes, sizeof(T));
  }
  std::string& buffer() { return buffer_; }

 private:
  std::string buffer_;
};

/// One line: a comment of two would break the header.
std::string single_line(std::string text) {
  for (char& c : text)
    if (c == '\n' || c == '\r') c = ' ';
  return text;
}

std::string header(const Parameterization& map) {
  std::string text = std::string("ply\nformat binary_little_endian 1.0\ncomment ") + kSignature + "\n";
  for (const std::string& line : map.provenance) text += "comment " + single_line(line) + "\n";
  const std::size_t counts[kElements] = {map.surface.positions.size(), map.surface.faces.size(),
                                         map.base.vertices.size(), map.base.faces.size(), map.base.creases.size()};
  for (int e = 0; e < kElements; ++e) {
    if (e == kCrease && counts[e] == 0) continue;
    text += std::string("element ") + layout()[e].name + " " + std::to_string(counts[e]) + "\n";
    for (const char* property : layout()[e].properties) text += std::string("property ") + property + "\n";
  }
  return text + "end_header\n";
}

/// A file in memory and a place in it. Lines and items past the end are the error Truncated.
class Input {
 public:
  explicit Input(const std::string& path) : path_(path) {
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    if (!file) throw Error(Cause::CannotOpen, "cannot open " + path);
    const std::streamoff size = file.tellg();
    // A folder opens, with a size that no file has.
    if (size < 0 || size == std::numeric_limits<std::streamoff>::max())
      throw Error(Cause::CannotOpen, "cannot read " + path);
    bytes_.resize(static_cast<std::size_t>(size));
    file.seekg(0);
    if (!file.read(bytes_.data(), size)) throw Error(Cause::CannotOpen, "cannot read " + path);
  }

  std::string_view line() {
    const std::size_t end = bytes_.find('\n', at_);
    if (end == std::string::npos) throw Error(Cause::Truncated, path_ + " ends within its header");
    std::string_view text(bytes_.data() + at_, end - at_);
    at_ = end + 1;
    ++line_;
    if (text.ends_with('\r')) text.remove_suffix(1);
    return text;
  }

  template <class T>
  T get() {
    if (remaining() < sizeof(T)) throw Error(Cause::Truncated, path_ + " ends within its data", Element::Byte, byte());
    T value;
    std::memcpy(&value, bytes_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    return value;
  }

  /// A list's length byte, which this format fixes.
  void length(int expected) {
    const long long place = byte();
    if (get<std::uint8_t>() != expected)
      throw Error(Cause::Malformed, path_ + " has a list of another length", Element::Byte, place);
  }

  std::size_t remaining() const { return bytes_.size() - at_; }
  long long byte() const { return static_cast<long long>(at_); }
  [[noreturn]] void malformed(const std::string& why) const {
    throw Error(Cause::Malformed, path_ + ": " + why, Element::Line, line_);
  }

 private:
  std::string path_, bytes_;
  std::size_t at_ = 0;
  int line_ = 0;
};

int parse_count(Input& in, std::string_view text) {
  long long count = -1;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (failure != std::errc() || end != text.data() + text.size() || count < 0 || count > INT_MAX / 3)
    in.malformed("an element's count is not a number of items");
  return static_cast<int>(count);
}

/// Checks the header line by line against the one layout there is; fills the provenance.
std::array<int, kElements> read_header(Input& in, Parameterization& map) {
  bool signed_by_gsp = false;
  const auto content = [&] {
    for (;;) {
      const std::string_view line = in.line();
      if (!line.starts_with("comment")) return line;
      const std::string_view text = line.substr(std::min<std::size_t>(line.size(), 8));
      if (text == kSignature)
        signed_by_gsp = true;
      else
        map.provenance.emplace_back(text);
    }
  };
  if (in.line() != "ply") in.malformed("not a PLY file");
  if (content() != "format binary_little_endian 1.0") in.malformed("not binary little-endian PLY");
  std::array<int, kElements> counts{};
  std::string_view element = content();
  for (int e = 0; e < kElements; ++e) {
    if (e == kCrease && element == "end_header") break;
    const std::string start = std::string("element ") + layout()[e].name + " ";
    if (!element.starts_with(start)) in.malformed("expected '" + start + "COUNT'");
    counts[e] = parse_count(in, element.substr(start.size()));
    for (const char* property : layout()[e].properties)
      if (content() != std::string("property ") + property)
        in.malformed(std::string("expected 'property ") + property + "'");
    element = content();
  }
  if (element != "end_header") in.malformed("expected 'end_header'");
  if (!signed_by_gsp) in.malformed(std::string("no comment '") + kSignature + "'");
  return counts;
}

/// The header's counts against the bytes that are there, before memory is taken for them.
void check_size(const Input& in, const std::array<int, kElements>& counts) {
  std::size_t expected = 0;
  for (int e = 0; e < kElements; ++e) expected += layout()[e].bytes * static_cast<std::size_t>(counts[e]);
  if (in.remaining() < expected)
    throw Error(Cause::Truncated,
                "the file holds " + std::to_string(in.remaining()) + " bytes of data, its header promises " +
                    std::to_string(expected),
                Element::Byte, in.byte() + static_cast<long long>(in.remaining()));
  if (in.remaining() > expected)
    throw Error(Cause::Malformed, "bytes after the data", Element::Byte, in.byte() + static_cast<long long>(expected));
}

void read_vertices(Input& in, int count, Parameterization& map) {
  map.surface.positions.resize(count);
  map.patch.resize(count);
  map.position.resize(count);
  for (int v = 0; v < count; ++v) {
    for (int k = 0; k < 3; ++k) map.surface.positions[v][k] = in.get<double>();
    map.patch[v] = in.get<std::int32_t>();
    const double first = in.get<double>(), second = in.get<double>();
    if (map.patch[v] >= 0) map.position[v] = chart_position(first, second);
  }
}

void read_faces(Input& in, int count, Parameterization& map) {
  map.surface.faces.resize(count);
  map.face_chart.resize(count);
  map.face_corners.resize(count);
  for (int f = 0; f < count; ++f) {
    in.length(3);
    for (int& v : map.surface.faces[f]) v = in.get<std::int32_t>();
    map.face_chart[f] = in.get<std::int32_t>();
    in.length(6);
    for (Complex& corner : map.face_corners[f]) {
      const double re = in.get<double>(), im = in.get<double>();
      corner = {re, im};
    }
  }
}

void read_base(Input& in, int vertices, int faces, BaseComplex& base) {
  base.vertices.resize(vertices);
  for (int& v : base.vertices) v = in.get<std::int32_t>();
  base.faces.resize(faces);
  for (int f = 0; f < faces; ++f) {
    in.length(3);
    for (int& b : base.faces[f]) {
      b = in.get<std::int32_t>();
      if (b < 0 || b >= vertices)
        throw Error(Cause::IndexOutOfRange, "a base face names a base vertex that does not exist", Element::Face, f);
    }
  }
  base.connect();
}

void read_creases(Input& in, int count, BaseComplex& base) {
  base.creases.resize(count);
  for (auto& crease : base.creases)
    for (int& b : crease) {
      b = in.get<std::int32_t>();
      if (b < 0 || b >= base.vertex_count())
        throw Error(Cause::IndexOutOfRange, "a crease names a base vertex that does not exist", Element::Vertex, b);
    }
}

}  // namespace

void write_parameterization(const std::string& path, const Parameterization& map) {
  require_well_formed(map);
  Output out;
  out.buffer() = header(map);
  for (int v = 0; v < map.surface.vertex_count(); ++v) {
    for (int k = 0; k < 3; ++k) out.put(map.surface.positions[v][k]);
    const bool placed = map.patch[v] >= 0;
    const std::array<double, 3> weights = chart_barycentric(map.position[v]);
    out.put<std::int32_t>(map.patch[v]);
    out.put(placed ? weights[0] : 0.0);
    out.put(placed ? weights[1] : 0.0);
  }
  for (int f = 0; f < map.surface.face_count(); ++f) {
    out.put<std::uint8_t>(3);
    for (int v : map.surface.faces[f]) out.put<std::int32_t>(v);
    out.put<std::int32_t>(map.face_chart[f]);
    out.put<std::uint8_t>(6);
    for (const Complex& corner : map.face_corners[f]) {
      out.put(corner.real());
      out.put(corner.imag());
    }
  }
  for (int v : map.base.vertices) out.put<std::int32_t>(v);
  for (const Triangle& t : map.base.faces) {
    out.put<std::uint8_t>(3);
    for (int b : t) out.put<std::int32_t>(b);
  }
  for (const auto& crease : map.base.creases)
    for (int b : crease) out.put<std::int32_t>(b);
  AtomicFile file(path);
  file.stream().write(out.buffer().data(), static_cast<std::streamsize>(out.buffer().size()));
  file.commit();
}

Parameterization read_parameterization(const std::string& path) {
  Input in(path);
  Parameterization map;
  const std::array<int, kElements> counts = read_header(in, map);
  check_size(in, counts);
  read_vertices(in, counts[0], map);
  read_faces(in, counts[1], map);
  read_base(in, counts[2], counts[3], map.base);
  read_creases(in, counts[kCrease], map.base);
  require_well_formed(map);
  return map;
}

}  // namespace gsp

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>

#include "mesh/error.h"
#include "mesh/files/text_scanner.h"
#include "mesh/ply.h"
#include "mesh/read_file.h"

namespace gsp {

namespace {

enum class Encoding { Ascii, LittleEndian, BigEndian };

/// Memory is reserved for at most this many values of a list per row ahead of reading them: a triangle's.
constexpr std::size_t kUsualListLength = 3;

std::optional<PlyType> type_named(std::string_view name) {
  static constexpr std::array<std::pair<std::string_view, PlyType>, 16> kNames = {{
      {"char", PlyType::Int8},
      {"int8", PlyType::Int8},
      {"uchar", PlyType::Uint8},
      {"uint8", PlyType::Uint8},
      {"short", PlyType::Int16},
      {"int16", PlyType::Int16},
      {"ushort", PlyType::Uint16},
      {"uint16", PlyType::Uint16},
      {"int", PlyType::Int32},
      {"int32", PlyType::Int32},
      {"uint", PlyType::Uint32},
      {"uint32", PlyType::Uint32},
      {"float", PlyType::Float32},
      {"float32", PlyType::Float32},
      {"double", PlyType::Float64},
      {"float64", PlyType::Float64},
  }};
  for (const auto& [known, type] : kNames)
    if (known == name) return type;
  return std::nullopt;
}

std::size_t size_of(PlyType type) {
  switch (type) {
    case PlyType::Int8:
    case PlyType::Uint8:
      return 1;
    case PlyType::Int16:
    case PlyType::Uint16:
      return 2;
    case PlyType::Int32:
    case PlyType::Uint32:
    case PlyType::Float32:
      return 4;
    case PlyType::Float64:
      return 8;
  }
  return 0;
}

bool is_integral(PlyType type) { return type < PlyType::Float32; }

/// The header's lines, which end as the first one does: a binary body may begin with a byte that looks like a line end.
class Header {
 public:
  explicit Header(std::string_view bytes) : bytes_(bytes) {
    const std::size_t end = bytes.find_first_of("\r\n");
    if (end == std::string_view::npos) return;
    ending_ = bytes[end] == '\n' ? "\n" : bytes.substr(end, 2) == "\r\n" ? "\r\n" : "\r";
  }

  std::string_view next_line() {
    ++line_;
    const std::size_t end = ending_.empty() ? std::string_view::npos : bytes_.find(ending_, position_);
    if (end == std::string_view::npos) fail(Cause::Truncated, "the file ends within the PLY header");
    std::string_view line = bytes_.substr(position_, end - position_);
    position_ = end + ending_.size();
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ' || line.back() == '\t')) line.remove_suffix(1);
    return line;
  }

  std::size_t position() const { return position_; }
  [[noreturn]] void fail(Cause cause, const std::string& sentence) const {
    throw Error(cause, sentence, Element::Line, line_);
  }

 private:
  std::string_view bytes_;
  std::string_view ending_;
  std::size_t position_ = 0;
  long long line_ = 0;
};

Encoding parse_format(const Header& header, TextScanner& words) {
  const std::string_view name = words.next(), version = words.next();
  if (version != "1.0") header.fail(Cause::Malformed, "the PLY format line has no version 1.0");
  if (name == "ascii") return Encoding::Ascii;
  if (name == "binary_little_endian") return Encoding::LittleEndian;
  if (name == "binary_big_endian") return Encoding::BigEndian;
  header.fail(Cause::Malformed, "unknown PLY format " + std::string(name));
}

PlyElement parse_element(const Header& header, TextScanner& words) {
  PlyElement element;
  element.name = words.next();
  long long count = -1;
  if (!parse_integer(words.next(), count) || count < 0)
    header.fail(Cause::Malformed, "a PLY element needs a name and a count");
  element.count = static_cast<std::size_t>(count);
  return element;
}

PlyProperty parse_property(const Header& header, TextScanner& words) {
  const auto type = [&](std::string_view name) {
    const std::optional<PlyType> known = type_named(name);
    if (!known) header.fail(Cause::Malformed, "unknown PLY type " + std::string(name));
    return *known;
  };
  PlyProperty property;
  std::string_view word = words.next();
  if (word == "list") {
    property.count_type = type(words.next());
    if (!is_integral(*property.count_type)) header.fail(Cause::Malformed, "a PLY list's length must be a whole number");
    word = words.next();
  }
  property.type = type(word);
  property.name = words.next();
  if (property.name.empty()) header.fail(Cause::Malformed, "a PLY property needs a name");
  return property;
}

/// Fills in the comments and the empty elements.
Encoding parse_header(Header& header, PlyDocument& document) {
  if (header.next_line() != "ply") header.fail(Cause::Malformed, "a PLY file starts with the line \"ply\"");
  std::optional<Encoding> encoding;
  for (;;) {
    const std::string_view line = header.next_line();
    TextScanner words(line);
    const std::string_view keyword = words.next();
    if (keyword == "end_header") break;
    if (keyword == "comment") {
      document.comments.emplace_back(line.substr(std::min(line.size(), line.find("comment") + 8)));
    } else if (keyword == "format") {
      encoding = parse_format(header, words);
    } else if (keyword == "element") {
      document.elements.push_back(parse_element(header, words));
    } else if (keyword == "property" && !document.elements.empty()) {
      document.elements.back().properties.push_back(parse_property(header, words));
    } else if (keyword != "obj_info" && !document.elements.empty() && !keyword.empty()) {
      // Ahead of the elements an unknown line cannot change what the body means: known writers drop "comment" there.
      header.fail(Cause::Malformed, "unknown PLY header line");
    }
  }
  if (!encoding) header.fail(Cause::Malformed, "the PLY header has no format line");
  return *encoding;
}

class AsciiBody {
 public:
  explicit AsciiBody(TextScanner scanner) : scanner_(scanner) {}

  double value(PlyType type) {
    const double value = scanner_.number();
    if (is_integral(type) && value != std::floor(value)) fail(Cause::Malformed, "a whole number should be here");
    return value;
  }
  /// How many more values the rest can hold: each but the last takes a digit and a space.
  std::size_t room(std::size_t values, std::size_t) const {
    return values == 0 ? SIZE_MAX : (scanner_.left() + 1) / (2 * values);
  }
  /// A row may take several lines, but shares none with the next.
  void end_row(const std::string& element) {
    if (const std::string_view token = scanner_.next_in_line(); !token.empty())
      fail(Cause::Malformed, quoted(token) + " is one value more than the header says for a row of element " + element);
  }
  void end() { scanner_.require_end("the PLY file should end after the rows that its header counts"); }
  [[noreturn]] void fail(Cause cause, const std::string& sentence) const { scanner_.fail(cause, sentence); }

 private:
  TextScanner scanner_;
};

template <bool kSwap>
class BinaryBody {
 public:
  BinaryBody(std::string_view bytes, std::size_t position) : bytes_(bytes), position_(position) {}

  double value(PlyType type) {
    switch (type) {
      case PlyType::Int8:
        return static_cast<std::int8_t>(take<std::uint8_t>());
      case PlyType::Uint8:
        return take<std::uint8_t>();
      case PlyType::Int16:
        return static_cast<std::int16_t>(take<std::uint16_t>());
      case PlyType::Uint16:
        return take<std::uint16_t>();
      case PlyType::Int32:
        return static_cast<std::int32_t>(take<std::uint32_t>());
      case PlyType::Uint32:
        return take<std::uint32_t>();
      case PlyType::Float32:
        return std::bit_cast<float>(take<std::uint32_t>());
      case PlyType::Float64:
        return std::bit_cast<double>(take<std::uint64_t>());
    }
    return 0.0;
  }
  std::size_t room(std::size_t, std::size_t size) const {
    return size == 0 ? SIZE_MAX : (bytes_.size() - position_) / size;
  }
  void end_row(const std::string&) {}
  /// White space and zeros are padding.
  void end() const {
    using namespace std::string_view_literals;
    const std::size_t more = bytes_.find_first_not_of("\0 \t\r\n"sv, position_);
    if (more != std::string_view::npos)
      fail(Cause::Malformed,
           std::to_string(bytes_.size() - position_) + " bytes follow the rows that the PLY header counts");
  }
  [[noreturn]] void fail(Cause cause, const std::string& sentence) const {
    throw Error(cause, sentence, Element::Byte, static_cast<long long>(position_));
  }

 private:
  template <typename Unsigned>
  Unsigned take() {
    std::array<unsigned char, sizeof(Unsigned)> raw;
    if (bytes_.size() - position_ < raw.size()) fail(Cause::Truncated, "the file ends within the PLY body");
    std::memcpy(raw.data(), bytes_.data() + position_, raw.size());
    position_ += raw.size();
    if constexpr (kSwap) std::reverse(raw.begin(), raw.end());
    return std::bit_cast<Unsigned>(raw);
  }

  std::string_view bytes_;
  std::size_t position_;
};

template <typename Body>
void read_list(Body& body, PlyProperty& property) {
  const double length = body.value(*property.count_type);
  if (length < 0) body.fail(Cause::Malformed, "a PLY list has a negative length");
  if (length > static_cast<double>(body.room(1, size_of(property.type))))
    body.fail(Cause::Truncated, "the file ends within a PLY list");
  for (auto left = static_cast<std::size_t>(length); left > 0; --left)
    property.values.push_back(body.value(property.type));
  property.starts.push_back(property.values.size());
}

template <typename Body>
void read_element(Body& body, PlyElement& element) {
  std::size_t row_size = 0;
  for (const PlyProperty& p : element.properties) row_size += size_of(p.is_list() ? *p.count_type : p.type);
  if (element.count > body.room(element.properties.size(), row_size))
    body.fail(Cause::Truncated, "the header promises " + std::to_string(element.count) + " of element " + element.name +
                                    ", more than the file can hold");
  if (element.properties.empty()) return;
  for (PlyProperty& p : element.properties) {
    if (p.is_list()) {
      p.starts.reserve(element.count + 1);
      p.starts.push_back(0);
      p.values.reserve(std::min(kUsualListLength * element.count, body.room(1, size_of(p.type))));
    } else {
      p.values.reserve(element.count);
    }
  }
  for (std::size_t row = 0; row < element.count; ++row) {
    for (PlyProperty& p : element.properties) {
      if (p.is_list())
        read_list(body, p);
      else
        p.values.push_back(body.value(p.type));
    }
    body.end_row(element.name);
  }
}

template <typename Body>
void read_body(Body body, PlyDocument& document) {
  for (PlyElement& element : document.elements) read_element(body, element);
  body.end();
}

}  // namespace

const PlyProperty* PlyElement::scalar(std::string_view property) const {
  for (const PlyProperty& p : properties)
    if (p.name == property && !p.is_list()) return &p;
  return nullptr;
}

const PlyProperty* PlyElement::list(std::string_view property) const {
  for (const PlyProperty& p : properties)
    if (p.name == property && p.is_list()) return &p;
  return nullptr;
}

const PlyElement* PlyDocument::find(std::string_view element) const {
  for (const PlyElement& e : elements)
    if (e.name == element) return &e;
  return nullptr;
}

PlyDocument parse_ply(std::string_view bytes) {
  static_assert(std::endian::native == std::endian::little, "BinaryBody takes little-endian for the machine's order");
  bytes = without_byte_order_mark(bytes);
  PlyDocument document;
  Header header(bytes);
  switch (parse_header(header, document)) {
    case Encoding::Ascii:
      read_body(AsciiBody(TextScanner(bytes, '\0', header.position())), document);
      break;
    case Encoding::LittleEndian:
      read_body(BinaryBody<false>(bytes, header.position()), document);
      break;
    case Encoding::BigEndian:
      read_body(BinaryBody<true>(bytes, header.position()), document);
      break;
  }
  return document;
}

PlyDocument read_ply(const std::string& path) { return parse_ply(read_file(path)); }

}  // namespace gsp

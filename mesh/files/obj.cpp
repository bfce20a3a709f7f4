#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "mesh/files/formats.h"
#include "mesh/files/polygon_builder.h"
#include "mesh/files/text_scanner.h"
#include "mesh/read_file.h"
#include "mesh/topology.h"

namespace gsp {

namespace {

/// Statements that say nothing of where the surface is: normals, texture, names, groups, display, files.
constexpr std::array<std::string_view, 18> kWithoutSurface = {
    "vn",     "vt",    "g",        "o",        "s",   "mg",         "usemtl",    "mtllib", "usemap",
    "maplib", "bevel", "c_interp", "d_interp", "lod", "shadow_obj", "trace_obj", "call",   "csh"};

/// Curves and surfaces of free form with what belongs to them, points and lines.
constexpr std::array<std::string_view, 24> kNotRead = {
    "p",    "l",    "vp", "curv", "curv2", "surf",  "cstype", "deg", "bmat", "step", "parm", "trim",
    "hole", "scrv", "sp", "end",  "con",   "ctech", "stech",  "bsp", "bzp",  "cdc",  "cdp",  "res"};

template <class Words>
bool contains(const Words& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// Whether an unknown keyword may stand for a vertex or a face: V, Face, v1.5 and f1/1/1 (no space).
bool is_like_vertex_or_face(std::string_view keyword) {
  std::string letters;
  for (const char c : keyword)
    if (std::isalpha(static_cast<unsigned char>(c))) letters += static_cast<char>(std::tolower(c));
  static constexpr std::array<std::string_view, 7> kLike = {"v", "f", "fo", "vertex", "face", "vert", "vtx"};
  const bool no_space = keyword.find_first_of("vVfF") == 0 && !std::isalpha(static_cast<unsigned char>(keyword[1]));
  return contains(kLike, letters) || (keyword.size() > 1 && no_space);
}

/// v, v/vt, v/vt/vn or v//vn, of which v is wanted. Some writers end with a slash.
bool parse_corner(std::string_view token, long long& vertex) {
  std::size_t slash = token.find('/');
  if (!parse_integer(token.substr(0, slash), vertex)) return false;
  for (int k = 0; k < 2 && slash != std::string_view::npos; ++k) {
    token.remove_prefix(slash + 1);
    slash = token.find('/');
    long long unused;
    if (const std::string_view part = token.substr(0, slash); !part.empty() && !parse_integer(part, unused))
      return false;
  }
  return slash == std::string_view::npos;
}

/// Vertices and polygons as they come. The polygons wait for the end, since a face may name a vertex that comes later.
class ObjReader {
 public:
  explicit ObjReader(std::string_view bytes) : text_(without_byte_order_mark(bytes), '#') { file_.numbering.first = 1; }

  SurfaceFile read() {
    while (!text_.at_end()) statement(text_.next_in_line());
    require_countable(file_.mesh.positions.size(), ends_.size());
    PolygonBuilder polygons(file_);
    std::size_t begin = 0;
    for (const std::size_t end : ends_) {
      polygons.add(std::span<const long long>(corners_).subspan(begin, end - begin));
      begin = end;
    }
    polygons.finish();
    note();
    return std::move(file_);
  }

 private:
  void statement(std::string_view keyword) {
    if (keyword == "v") return vertex();
    if (keyword == "f" || keyword == "fo") return face();  // the same until version 2.11 of the format
    if (contains(kNotRead, keyword)) {
      ++not_read_[std::string(keyword)];
    } else if (!contains(kWithoutSurface, keyword)) {
      if (is_like_vertex_or_face(keyword))
        text_.fail(Cause::Malformed,
                   "the OBJ keyword " + quoted(keyword) + " is none, but like that of a vertex or face");
      ++unknown_;
      if (first_unknown_.empty()) first_unknown_ = quoted(keyword) + " on line " + std::to_string(text_.line());
    }
    while (!next().empty()) continue;
  }

  /// The rest of the line's tokens; a backslash at the line's end joins the next line to it.
  std::string_view next() {
    std::string_view token = text_.next_in_line();
    while (token == "\\") {
      text_.skip_line();
      token = text_.next_in_line();
    }
    if (token.size() > 1 && token.back() == '\\') {
      text_.put_back(1);
      token.remove_suffix(1);
    }
    return token;
  }

  /// x y z, x y z w, or a position with a colour of three or four numbers.
  void vertex() {
    std::array<double, 7> numbers;
    std::size_t count = 0;
    for (std::string_view token = next(); !token.empty(); token = next()) {
      if (count == numbers.size()) text_.fail(Cause::Malformed, "an OBJ vertex has more than seven numbers");
      if (!parse_number(token, numbers[count++])) text_.fail(Cause::Malformed, quoted(token) + " is not a number");
    }
    if (count < 3) text_.fail(Cause::Malformed, "an OBJ vertex needs three numbers");
    if (count == 5)
      text_.fail(Cause::Malformed, "an OBJ vertex of five numbers: neither a weight nor a colour follows");
    Vec3 p(numbers[0], numbers[1], numbers[2]);
    if (count == 4 && numbers[3] != 1.0) {
      if (numbers[3] == 0.0 || !std::isfinite(numbers[3]))
        text_.fail(Cause::Malformed, "the weight of an OBJ vertex must be a finite number other than 0");
      p /= numbers[3];
      ++weighted_;
    }
    file_.mesh.positions.push_back(p);
  }

  void face() {
    const auto vertices = static_cast<long long>(file_.mesh.positions.size());
    for (std::string_view token = next(); !token.empty(); token = next()) {
      long long index;
      if (!parse_corner(token, index))
        text_.fail(Cause::Malformed,
                   quoted(token) + " is no corner of an OBJ face: whole numbers are, as v, v/vt, v/vt/vn or v//vn");
      if (index < -vertices)
        text_.fail(Cause::IndexOutOfRange, "a face counts " + std::to_string(index) + " vertices, but there are " +
                                               std::to_string(vertices) + " before it");
      corners_.push_back(index < 0 ? vertices + index : index - 1);
    }
    ends_.push_back(corners_.size());
  }

  void note() {
    if (weighted_ > 0)
      file_.notes.push_back(
          std::to_string(weighted_) +
          " vertices have a fourth number that is not 1: it is taken as their weight, and divides them");
    for (const auto& [keyword, count] : not_read_)
      file_.notes.push_back(std::to_string(count) + " OBJ statements " + keyword +
                            " (points, lines, free-form curves and surfaces) are not read");
    if (unknown_ > 0)
      file_.notes.push_back(std::to_string(unknown_) +
                            " OBJ statements have an unknown keyword and are not read, first " + first_unknown_);
  }

  TextScanner text_;
  SurfaceFile file_;
  std::vector<long long> corners_;
  std::vector<std::size_t> ends_;
  std::map<std::string, long long> not_read_;
  long long unknown_ = 0, weighted_ = 0;
  std::string first_unknown_;
};

}  // namespace

SurfaceFile parse_obj(std::string_view bytes) { return ObjReader(bytes).read(); }

}  // namespace gsp

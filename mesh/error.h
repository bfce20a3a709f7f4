#pragma once

#include <optional>
#include <stdexcept>
#include <string>

#include "mesh/export.h"

namespace GSP_PUBLIC gsp {

/// Why an operation could not be done. Each maps to one exit status of the command line (`exit_status`).
enum class Cause {
  // Unusable input, exit status 3.
  CannotOpen,               ///< the file is missing or may not be read
  UnknownFormat,            ///< the name's ending is none of the supported ones
  Malformed,                ///< the bytes do not follow the format
  Truncated,                ///< the file ends before what its header promises
  IndexOutOfRange,          ///< a face names a vertex that does not exist
  NoFaces,                  ///< a point cloud, wire frame or empty file
  NonFinite,                ///< a coordinate is NaN or infinite, or too large to square
  TooSmall,                 ///< a surface whose areas are too small to compute with
  NoArea,                   ///< a component of which no face has an area
  NonManifoldEdge,          ///< an edge of more than two faces
  NonManifoldVertex,        ///< a vertex whose faces form more than one fan
  InconsistentOrientation,  ///< two faces run through their common edge the same way, or the surface has one side only
  DegenerateFace,           ///< a face that names a vertex twice
  DuplicateFace,            ///< two faces on the same three vertices
  PolygonNotSimple,         ///< a polygon of a file that crosses or touches itself, seen along its normal
  ComponentTooSmall,        ///< a component with too few vertices to carry a base complex
  NoSubdivisionConnectivity,  ///< a plain mesh that was expected to be semi-regular
  BadStream,                  ///< a coded mesh whose header is damaged
  // The operation failed on usable input, exit status 1.
  CannotWrite,   ///< the output could not be written whole
  InvalidMap,    ///< no map with positive areas was found
  SolverFailed,  ///< the linear system could not be factorized or solved
  Cancelled,     ///< the progress callback asked to stop
  ToolMissing,   ///< an external program (gnuplot) is not there
  ToolFailed,    ///< it ended with another exit status than 0, by a signal, or without its output
  TimedOut,      ///< it was still running at its time limit
  OutOfMemory,   ///< there is not enough memory
  Internal,      ///< an invariant does not hold: a bug in gsp
  // Wrong usage, exit status 2.
  BadOption,  ///< an option's value is out of its range
};

/// A short stable name, for tables and JSON: "non-manifold-edge".
const char* cause_name(Cause cause);

/// Exit status of the command line: 1 failed, 2 wrong usage, 3 unusable input.
int exit_status(Cause cause);

/// What an error's index counts.
enum class Element { None, Vertex, Edge, Face, Line, Byte, Component };

const char* element_name(Element element);

/// What an error is about. `index` counts from 0 for vertices, faces, components and bytes, from 1 for lines. An edge
/// is named by the vertices at its ends, or alone by its number.
struct Place {
  Element element = Element::None;
  long long index = 0;
  std::optional<long long> end = {};  ///< an edge's second vertex
};

/// The one exception type of gsp: a named cause, a sentence, and the place that is at fault.
/// `what()` is the sentence with the place appended.
class Error : public std::runtime_error {
 public:
  Error(Cause cause, const std::string& sentence);
  Error(Cause cause, const std::string& sentence, const Place& place);
  Error(Cause cause, const std::string& sentence, Element element, long long index)
      : Error(cause, sentence, Place{element, index}) {}

  Cause cause() const { return cause_; }
  Element element() const { return place_ ? place_->element : Element::None; }
  std::optional<long long> index() const { return place_ ? std::optional<long long>(place_->index) : std::nullopt; }
  const std::optional<Place>& place() const { return place_; }

  /// The same error with the name of the file or cell it happened in put before the sentence.
  Error within(const std::string& where) const;
  /// The same error about the same thing, counted another way.
  Error at(const Place& place) const;

 private:
  Cause cause_;
  std::string sentence_;
  std::optional<Place> place_;
};

}  // namespace gsp

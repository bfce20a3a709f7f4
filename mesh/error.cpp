#include "mesh/error.h"

namespace gsp {

namespace {

std::string with_place(const std::string& sentence, const Place& place) {
  const std::string index = std::to_string(place.index);
  if (place.end) return sentence + " (the edge of vertices " + index + " and " + std::to_string(*place.end) + ")";
  return sentence + " (" + element_name(place.element) + " " + index + ")";
}

}  // namespace

const char* cause_name(Cause cause) {
  switch (cause) {
    case Cause::CannotOpen:
      return "cannot-open";
    case Cause::UnknownFormat:
      return "unknown-format";
    case Cause::Malformed:
      return "malformed";
    case Cause::Truncated:
      return "truncated";
    case Cause::IndexOutOfRange:
      return "index-out-of-range";
    case Cause::NoFaces:
      return "no-faces";
    case Cause::NonFinite:
      return "non-finite";
    case Cause::TooSmall:
      return "too-small";
    case Cause::NoArea:
      return "no-area";
    case Cause::NonManifoldEdge:
      return "non-manifold-edge";
    case Cause::NonManifoldVertex:
      return "non-manifold-vertex";
    case Cause::InconsistentOrientation:
      return "inconsistent-orientation";
    case Cause::DegenerateFace:
      return "degenerate-face";
    case Cause::DuplicateFace:
      return "duplicate-face";
    case Cause::PolygonNotSimple:
      return "polygon-not-simple";
    case Cause::ComponentTooSmall:
      return "component-too-small";
    case Cause::NoSubdivisionConnectivity:
      return "no-subdivision-connectivity";
    case Cause::BadStream:
      return "bad-stream";
    case Cause::CannotWrite:
      return "cannot-write";
    case Cause::InvalidMap:
      return "invalid-map";
    case Cause::SolverFailed:
      return "solver-failed";
    case Cause::Cancelled:
      return "cancelled";
    case Cause::ToolMissing:
      return "tool-missing";
    case Cause::ToolFailed:
      return "tool-failed";
    case Cause::TimedOut:
      return "timed-out";
    case Cause::OutOfMemory:
      return "out-of-memory";
    case Cause::Internal:
      return "internal";
    case Cause::BadOption:
      return "bad-option";
  }
  return "unknown";
}

int exit_status(Cause cause) {
  if (cause == Cause::BadOption) return 2;
  return cause < Cause::CannotWrite ? 3 : 1;
}

const char* element_name(Element element) {
  switch (element) {
    case Element::None:
      return "";
    case Element::Vertex:
      return "vertex";
    case Element::Edge:
      return "edge";
    case Element::Face:
      return "face";
    case Element::Line:
      return "line";
    case Element::Byte:
      return "byte";
    case Element::Component:
      return "component";
  }
  return "";
}

Error::Error(Cause cause, const std::string& sentence)
    : std::runtime_error(sentence), cause_(cause), sentence_(sentence) {}

Error::Error(Cause cause, const std::string& sentence, const Place& place)
    : std::runtime_error(with_place(sentence, place)), cause_(cause), sentence_(sentence), place_(place) {}

Error Error::within(const std::string& where) const {
  const std::string sentence = where + ": " + sentence_;
  return place_ ? Error(cause_, sentence, *place_) : Error(cause_, sentence);
}

Error Error::at(const Place& place) const { return Error(cause_, sentence_, place); }

}  // namespace gsp

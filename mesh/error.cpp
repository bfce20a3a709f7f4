#include "mesh/error.h"

namespace gsp {

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

Error::Error(Cause cause, const std::string& sentence) : std::runtime_error(sentence), cause_(cause) {}

Error::Error(Cause cause, const std::string& sentence, Element element, long long index)
    : std::runtime_error(sentence + " (" + element_name(element) + " " + std::to_string(index) + ")"),
      cause_(cause),
      element_(element),
      index_(index) {}

Error Error::within(const std::string& where) const {
  Error error(cause_, where + ": " + what());
  error.element_ = element_;
  error.index_ = index_;
  return error;
}

}  // namespace gsp

#include "remesh/remesh_options.h"

#include "mesh/words.h"

namespace gsp {

const char* positions_name(Positions positions) {
  switch (positions) {
    case Positions::Sampled:
      return "sampled";
    case Positions::Closest:
      return "closest";
    default:
      return "fitted";
  }
}

const char* remesh_kind_name(RemeshKind kind) {
  switch (kind) {
    case RemeshKind::Normal:
      return "normal";
    case RemeshKind::VariationalNormal:
      return "variational-normal";
    case RemeshKind::Displaced:
      return "displaced";
    default:
      return "parametric";
  }
}

Positions positions_of(const std::string& word) { return value_of(kPositions, positions_name, word, "positions"); }

RemeshKind remesh_kind_of(const std::string& word) { return value_of(kRemeshKinds, remesh_kind_name, word, "kind"); }

std::vector<std::string> provenance_of(const RemeshOptions& options) {
  return {std::string("kind ") + remesh_kind_name(options.kind),
          std::string("positions ") + positions_name(options.positions)};
}

}  // namespace gsp

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

const char* prediction_name(Prediction prediction) {
  switch (prediction) {
    case Prediction::Loop:
      return "loop";
    case Prediction::ButterflyLifted:
      return "butterfly-lifted";
    default:
      return "butterfly";
  }
}

Positions positions_of(const std::string& word) { return value_of(kPositions, positions_name, word, "positions"); }

Prediction prediction_of(const std::string& word) { return value_of(kPredictions, prediction_name, word, "predict"); }

RemeshKind remesh_kind_of(const std::string& word) { return value_of(kRemeshKinds, remesh_kind_name, word, "kind"); }

std::vector<std::string> provenance_of(const RemeshOptions& options) {
  std::vector<std::string> said = {std::string("kind ") + remesh_kind_name(options.kind),
                                   std::string("positions ") + positions_name(options.positions)};
  if (options.kind == RemeshKind::Normal || options.kind == RemeshKind::VariationalNormal)
    said.push_back(std::string("predict ") + prediction_name(options.predict));
  return said;
}

}  // namespace gsp

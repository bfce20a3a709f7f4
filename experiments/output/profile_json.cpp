#include "experiments/output/profile_json.h"

#include <nlohmann/json.hpp>

namespace gsp {

nlohmann::ordered_json profile_json(const std::vector<ProfileStep>& steps) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const ProfileStep& s : steps)
    all.push_back({{"step", s.name},
                   {"depth", s.depth},
                   {"runs", s.runs},
                   {"seconds", s.seconds},
                   {"cpu_seconds", s.cpu_seconds},
                   {"peak_megabytes", s.peak_megabytes}});
  return all;
}

std::vector<ProfileStep> profile_of_json(const nlohmann::ordered_json& steps) {
  std::vector<ProfileStep> all;
  for (const auto& s : steps)
    all.push_back({s.at("step").get<std::string>(), s.at("depth").get<int>(), s.at("runs").get<int>(),
                   s.at("seconds").get<double>(), s.at("cpu_seconds").get<double>(),
                   s.at("peak_megabytes").get<double>()});
  return all;
}

}  // namespace gsp

#include "experiments/curve/point_fields.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <set>

#include "experiments/curve/curve_csv.h"
#include "experiments/store/json_file.h"
#include "mesh/read_file.h"
#include "tests/temporary_folder.h"

using namespace gsp;

namespace {

// A point whose every field has a value of its own.
CurvePoint numbered_point() {
  CurvePoint point;
  int next = 1;
  const auto set = [&](auto& value) {
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::string>)
      value = "word " + std::to_string(next++) + ", \"quoted\"";
    else
      value = static_cast<std::decay_t<decltype(value)>>(next++);
  };
  for (const PointField& field : point_fields()) std::visit([&](auto member) { set(point.*member); }, field.member);
  return point;
}

bool same(const PointField& field, const CurvePoint& a, const CurvePoint& b) {
  return std::visit([&](auto member) { return a.*member == b.*member; }, field.member);
}

}  // namespace

TEST_CASE("every field has a name, a meaning and a member of its own") {
  std::set<std::string> names;
  for (const PointField& field : point_fields()) {
    CHECK(names.insert(field.name).second);
    CHECK(std::string(field.meaning).size() > 3);
    int holders = 0;
    for (const PointField& other : point_fields()) holders += other.member == field.member;
    CHECK(holders == 1);
  }
}

TEST_CASE("every field survives curve.csv, and every measured one JSON") {
  const TemporaryFolder folder;
  const CurvePoint point = numbered_point();
  write_curve_csv(folder.file("curve.csv"), {point});
  const std::vector<CurvePoint> read = read_curve_csv(folder.file("curve.csv"));
  REQUIRE(read.size() == 1);
  const CurvePoint measured = measured_point(measured_json(point));
  for (const PointField& field : point_fields()) {
    INFO(field.name);
    CHECK(same(field, point, read.front()));
    CHECK(same(field, field.measured ? point : CurvePoint(), measured));
  }
}

TEST_CASE("README.md has the table of the columns") {
  INFO(point_fields_table());
  CHECK(read_file(GSP_README).find(point_fields_table()) != std::string::npos);
}

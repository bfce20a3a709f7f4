#include "remesh/scalar/scalar_synthesis.h"

#include "mesh/parallel.h"
#include "remesh/filters/butterfly_low_pass.h"
#include "remesh/filters/butterfly_update.h"

namespace gsp {

namespace {

constexpr std::size_t kRows = 8192;

/// y += factor·matrix·x.
void add_rows(const SparseMatrix& matrix, double factor, const Vec3* x, Vec3* y) {
  parallel_for(static_cast<std::size_t>(matrix.rows()), kRows, [&](std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r) {
      Vec3 sum = Vec3::Zero();
      for (SparseMatrix::InnerIterator it(matrix, static_cast<Eigen::Index>(r)); it; ++it)
        sum += it.value() * x[it.col()];
      y[r] += factor * sum;
    }
  });
}

std::vector<Frame> frames_of(const SubdivisionLevel& level, const std::vector<Vec3>& positions) {
  const EdgeFrames frames(level, positions);
  std::vector<Frame> all(level.edges.size());
  parallel_for(all.size(), kRows, [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) all[e] = frames(static_cast<int>(e));
  });
  return all;
}

}  // namespace

ScalarForm ScalarForm::plus(const ScalarForm& other, double factor) const {
  ScalarForm sum = *this;
  for (std::size_t v = 0; v < base.size(); ++v) sum.base[v] += factor * other.base[v];
  for (std::size_t n = 0; n < details.size(); ++n) sum.details[n] += factor * other.details[n];
  return sum;
}

double ScalarForm::dot(const ScalarForm& other) const {
  double sum = 0.0;
  for (std::size_t v = 0; v < base.size(); ++v) sum += base[v].dot(other.base[v]);
  for (std::size_t n = 0; n < details.size(); ++n) sum += details[n].dot(other.details[n]);
  return sum;
}

ScalarSynthesis::ScalarSynthesis(const std::vector<SubdivisionLevel>& levels, const std::vector<char>& exceptional,
                                 bool lifted)
    : levels_(levels), exceptional_(exceptional) {
  for (std::size_t l = 0; l + 1 < levels.size(); ++l) {
    const int vertices = levels[l].vertex_count, edges = levels[l].edge_count();
    Step& step = steps_.emplace_back();
    step.low_pass = butterfly_low_pass(levels[l])->matrix(vertices + edges, vertices);
    step.low_pass_transposed = step.low_pass.transpose();
    if (!lifted) continue;
    step.update = butterfly_update(levels[l])->matrix(vertices, edges);
    step.update_transposed = step.update.transpose();
  }
}

std::vector<Vec3> ScalarSynthesis::synthesis(int level, const std::vector<Vec3>& coarse,
                                             const std::vector<Vec3>& details) const {
  const Step& step = steps_[level];
  std::vector<Vec3> old = coarse;
  if (step.update.size() > 0) add_rows(step.update, -1.0, details.data(), old.data());
  std::vector<Vec3> fine(coarse.size() + details.size(), Vec3::Zero());
  add_rows(step.low_pass, 1.0, old.data(), fine.data());
  for (std::size_t e = 0; e < details.size(); ++e) fine[coarse.size() + e] += details[e];
  return fine;
}

ScalarForm ScalarSynthesis::of(const std::vector<Vec3>& positions) const {
  // From the finest level down, the positions and vectors of the transform itself.
  std::vector<std::vector<Vec3>> wanted(steps_.size() + 1), vectors(steps_.size());
  wanted.back() = positions;
  for (int l = detail_levels() - 1; l >= 0; --l) {
    const std::vector<Vec3>& fine = wanted[l + 1];
    const std::ptrdiff_t count = levels_[l].vertex_count;
    std::vector<Vec3> coarse(fine.begin(), fine.begin() + count), predicted(fine.size(), Vec3::Zero());
    add_rows(steps_[l].low_pass, 1.0, coarse.data(), predicted.data());
    vectors[l].assign(fine.begin() + count, fine.end());
    for (std::size_t e = 0; e < vectors[l].size(); ++e) vectors[l][e] -= predicted[count + e];
    if (steps_[l].update.size() > 0) add_rows(steps_[l].update, 1.0, vectors[l].data(), coarse.data());
    wanted[l] = std::move(coarse);
  }
  // Up again, with what a form can hold of them.
  ScalarForm form{wanted[0], {}};
  std::vector<Vec3> here = wanted[0];
  for (int l = 0; l < detail_levels(); ++l) {
    const std::vector<Frame> frames = frames_of(levels_[l], here);
    const std::vector<Vec3> reached = synthesis(l, here, vectors[l]);
    for (std::size_t e = 0; e < frames.size(); ++e) {
      const std::size_t v = here.size() + e;
      Vec3 local = frames[e].transpose() * (vectors[l][e] + wanted[l + 1][v] - reached[v]);
      if (!exceptional_[first(l) + e]) local.tail<2>().setZero();
      vectors[l][e] = frames[e] * local;
      form.details.push_back(local);
    }
    here = synthesis(l, here, vectors[l]);
  }
  return form;
}

std::vector<Vec3> ScalarSynthesis::turned_out(int level, const std::vector<Vec3>& local) const {
  std::vector<Vec3> details(frames_[level].size());
  for (std::size_t e = 0; e < details.size(); ++e) {
    const Vec3& d = local[first(level) + e];
    details[e] = exceptional_[first(level) + e] ? Vec3(frames_[level][e] * d) : Vec3(d.x() * frames_[level][e].col(0));
  }
  return details;
}

std::vector<Vec3> ScalarSynthesis::positions(const ScalarForm& form) {
  std::vector<Vec3> here = form.base;
  frames_.assign(steps_.size(), {});
  for (int l = 0; l < detail_levels(); ++l) {
    frames_[l] = frames_of(levels_[l], here);
    here = synthesis(l, here, turned_out(l, form.details));
  }
  return here;
}

std::vector<Vec3> ScalarSynthesis::moves(const ScalarForm& change) const {
  std::vector<Vec3> here = change.base;
  for (int l = 0; l < detail_levels(); ++l) here = synthesis(l, here, turned_out(l, change.details));
  return here;
}

ScalarForm ScalarSynthesis::pulled(std::vector<Vec3> forces) const {
  ScalarForm form;
  form.details.resize(forces.size() - levels_[0].vertex_count);
  for (int l = detail_levels() - 1; l >= 0; --l) {
    const int vertices = levels_[l].vertex_count;
    std::vector<Vec3> coarse(vertices, Vec3::Zero());
    add_rows(steps_[l].low_pass_transposed, 1.0, forces.data(), coarse.data());
    std::vector<Vec3> details(forces.begin() + vertices, forces.end());
    if (steps_[l].update.size() > 0) add_rows(steps_[l].update_transposed, -1.0, coarse.data(), details.data());
    Vec3* local = form.details.data() + first(l);
    for (std::size_t e = 0; e < details.size(); ++e) {
      local[e] = frames_[l][e].transpose() * details[e];
      if (!exceptional_[first(l) + e]) local[e].tail<2>().setZero();
    }
    forces = std::move(coarse);
  }
  form.base = std::move(forces);
  return form;
}

}  // namespace gsp

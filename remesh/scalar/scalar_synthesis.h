#pragma once

#include <vector>

#include "remesh/filters/filter.h"
#include "remesh/filters/local_frames.h"
#include "remesh/semiregular.h"

namespace gsp {

/// A remesh as base positions and, for each vertex above them in the order of semiregular.h, its detail in the frame of
/// its edge (local_frames.h): a normal component only, but for exceptions, which have three.
struct ScalarForm {
  std::vector<Vec3> base;     ///< #B
  std::vector<Vec3> details;  ///< #V - #B

  ScalarForm plus(const ScalarForm& other, double factor) const;
  double dot(const ScalarForm& other) const;
};

/// Synthesis of such a mesh by Butterfly, or lifted Butterfly, as a decoder does it; its derivative with the frames
/// held, and the transpose of that. What coarse moves turn of finer frames is left out: it is smaller by the size of a
/// detail over its edge.
class ScalarSynthesis {
 public:
  /// `levels`: from the base to the finest; kept by reference. O(V).
  /// `exceptional`: #V - #B, the details of three components; kept by reference too.
  ScalarSynthesis(const std::vector<SubdivisionLevel>& levels, const std::vector<char>& exceptional, bool lifted);

  /// The form nearest to a mesh, level by level: the normal parts of what its coarser levels, as they come out, leave
  /// to be added. O(V).
  ScalarForm of(const std::vector<Vec3>& positions) const;
  /// #V. Keeps the frames for the two below. O(V).
  std::vector<Vec3> positions(const ScalarForm& form);
  /// #V moves of the vertices for a change of the form, with the frames of the last `positions`.
  std::vector<Vec3> moves(const ScalarForm& change) const;
  /// The transpose: of a force on each vertex, that on the form.
  ScalarForm pulled(std::vector<Vec3> forces) const;

 private:
  struct Step {
    SparseMatrix low_pass, low_pass_transposed;
    SparseMatrix update, update_transposed;  ///< empty where nothing is lifted
  };
  int detail_levels() const { return static_cast<int>(steps_.size()); }
  std::vector<Vec3> synthesis(int level, const std::vector<Vec3>& coarse, const std::vector<Vec3>& details) const;
  /// Of the level's first edge, among all details.
  std::size_t first(int level) const { return levels_[level].vertex_count - levels_[0].vertex_count; }
  std::vector<Vec3> turned_out(int level, const std::vector<Vec3>& local) const;

  const std::vector<SubdivisionLevel>& levels_;
  const std::vector<char>& exceptional_;
  std::vector<Step> steps_;
  std::vector<std::vector<Frame>> frames_;  ///< of each level that has details
};

}  // namespace gsp

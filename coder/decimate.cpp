#include "coder/anchors.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_plane_policies.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <functional>

#include "mesh/error.h"
#include "mesh/topology.h"

namespace gsp {

namespace {

namespace simplification = CGAL::Surface_mesh_simplification;
using Kernel = CGAL::Simple_cartesian<double>;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

// A surface about the origin, where sums of squares keep their digits.
class Centred {
 public:
  explicit Centred(const Mesh& mesh) {
    Eigen::AlignedBox3d box;
    for (const Triangle& t : mesh.faces)
      for (int v : t) box.extend(mesh.positions[v]);
    centre_ = box.center();
    surface_.reserve(mesh.vertex_count(), 3 * mesh.face_count() / 2, mesh.face_count());
    std::vector<Surface::Vertex_index> vertices(mesh.positions.size());
    for (int f = 0; f < mesh.face_count(); ++f) {
      std::array<Surface::Vertex_index, 3> corners;
      for (int k = 0; k < 3; ++k) {
        Surface::Vertex_index& vertex = vertices[mesh.faces[f][k]];
        const Vec3 p = mesh.positions[mesh.faces[f][k]] - centre_;
        if (!vertex.is_valid()) vertex = surface_.add_vertex({p.x(), p.y(), p.z()});
        corners[k] = vertex;
      }
      if (!surface_.add_face(corners).is_valid())
        throw Error(Cause::NonManifoldEdge, "decimation needs a manifold surface", Element::Face, f);
    }
  }

  Surface& surface() { return surface_; }

  Mesh mesh() const {
    Mesh result;
    std::vector<int> index(surface_.num_vertices(), -1);
    for (const Surface::Face_index face : surface_.faces()) {
      Triangle t;
      int k = 0;
      for (const Surface::Vertex_index vertex : surface_.vertices_around_face(surface_.halfedge(face))) {
        int& i = index[vertex];
        if (i < 0) {
          i = result.vertex_count();
          const Kernel::Point_3& p = surface_.point(vertex);
          result.positions.push_back(centre_ + Vec3(p.x(), p.y(), p.z()));
        }
        t[k++] = i;
      }
      result.faces.push_back(t);
    }
    return result;
  }

 private:
  Vec3 centre_;
  Surface surface_;
};

using Quadrics = simplification::GarlandHeckbert_plane_policies<Surface, Kernel>;

// Where the sum of squares is least; of all such points, as on flat and straight parts, the one next to the middle of
// the edge. CGAL's own placement takes the first answer of a system that rounding alone keeps from being singular.
class BestPlace {
 public:
  explicit BestPlace(const Quadrics& quadrics) : quadrics_(&quadrics) {}

  template <class Profile>
  boost::optional<Kernel::Point_3> operator()(const Profile& profile) const {
    const Eigen::Matrix4d quadric = get(quadrics_->vcm(), profile.v0()) + get(quadrics_->vcm(), profile.v1());
    const Eigen::Matrix3d a = quadric.topLeftCorner<3, 3>();
    const Vec3 middle = 0.5 * (vector(profile.p0()) + vector(profile.p1()));
    const Vec3 gradient = a * middle + quadric.topRightCorner<3, 1>();
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
    eigen.computeDirect(a);
    Vec3 place = middle;
    for (int k = 0; k < 3; ++k)
      if (eigen.eigenvalues()[k] > kFlat * eigen.eigenvalues()[2])
        place -= eigen.eigenvectors().col(k).dot(gradient) / eigen.eigenvalues()[k] * eigen.eigenvectors().col(k);
    return Kernel::Point_3(place.x(), place.y(), place.z());
  }

 private:
  static Vec3 vector(const Kernel::Point_3& p) { return {p.x(), p.y(), p.z()}; }

  // Squared sine of the angle between normals, about: those of single precision on a plane differ by 1e-12, those of a
  // scan by 1e-4. Between 1e-10 and 1e-6 it changes nothing.
  static constexpr double kFlat = 1e-8;
  const Quadrics* quadrics_;
};

// Asked before every collapse whether to stop: keeps the surface at each count and stops after the last.
class Snapshots {
 public:
  Snapshots(const Centred& surface, const std::vector<int>& face_counts, std::vector<Mesh>& results, Progress& progress)
      : surface_(&surface), face_counts_(&face_counts), results_(&results), progress_(&progress) {}

  template <class Cost, class Profile>
  bool operator()(const Cost&, const Profile& profile, std::size_t, std::size_t) const {
    take(static_cast<int>(profile.surface_mesh().number_of_faces()));
    return results_->size() == face_counts_->size();
  }

  void take(int faces) const {
    while (results_->size() < face_counts_->size() && faces <= (*face_counts_)[results_->size()]) {
      progress_->report("decimate", static_cast<double>(results_->size()) / static_cast<double>(face_counts_->size()));
      results_->push_back(surface_->mesh());
    }
  }

 private:
  const Centred* surface_;
  const std::vector<int>* face_counts_;
  std::vector<Mesh>* results_;
  Progress* progress_;
};

}  // namespace

std::vector<Mesh> decimate(const Mesh& mesh, const std::vector<int>& face_counts, Decimation decimation,
                           Progress& progress) {
  if (!std::is_sorted(face_counts.begin(), face_counts.end(), std::greater<>()) ||
      (!face_counts.empty() && face_counts.back() < 1))
    throw Error(Cause::BadOption, "face counts of a decimation must be positive and fall");
  std::vector<Mesh> results;
  while (results.size() < face_counts.size() && face_counts[results.size()] >= mesh.face_count())
    results.push_back(mesh);
  if (results.size() == face_counts.size()) return results;
  // CGAL takes such a vertex, and breaks where it collapses an edge of it.
  if (const TopologyReport report = topology_report(mesh); !report.non_manifold_vertices.empty())
    throw Error(Cause::NonManifoldVertex, "decimation needs a manifold surface", Element::Vertex,
                report.non_manifold_vertices.front());
  Centred centred(mesh);
  Surface& surface = centred.surface();
  const Snapshots snapshots(centred, face_counts, results, progress);
  if (decimation == Decimation::Quadrics) {
    const Quadrics quadrics(surface);
    simplification::edge_collapse(surface, snapshots,
                                  CGAL::parameters::get_cost(quadrics).get_placement(BestPlace(quadrics)));
  } else {
    simplification::edge_collapse(surface, snapshots,
                                  CGAL::parameters::get_cost(simplification::LindstromTurk_cost<Surface>())
                                      .get_placement(simplification::LindstromTurk_placement<Surface>()));
  }
  snapshots.take(static_cast<int>(surface.number_of_faces()));
  return results;
}

}  // namespace gsp

#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <vector>

#include "coder/codec.h"
#include "mesh/mesh.h"
#include "param/map/lattice.h"

/// NumPy arrays and ours. What comes in is looked at row by row and copied; what goes out keeps its memory.
namespace gsp::python {

namespace py = pybind11;

/// A surface of `positions` (n, 3), any real type, and `faces` (m, 3), any integer type, strided as they may be.
/// Throws TypeError for other types, ValueError for other shapes, Error(IndexOutOfRange) with the first face that names
/// no vertex.
Mesh mesh_of(const py::object& positions, const py::object& faces);

/// Positions alone, as `mesh_of` takes them.
std::vector<Vec3> positions_of(const py::object& positions);
/// (k, N) integers, as `mesh_of` takes faces; `what` names them in messages.
std::vector<Triangle> triangles_of(const py::object& rows, const char* what);
std::vector<std::array<int, 2>> pairs_of(const py::object& rows, const char* what);
/// (n,) real numbers.
std::vector<double> numbers_of(const py::object& values, const char* what);

/// At most `most` bytes from the start of bytes, bytearray, memoryview or an array of uint8.
Bytes bytes_of(const py::object& buffer, std::size_t most);
py::bytes to_bytes(const Bytes& bytes);

enum class Access { Read, Write };

/// Views of memory that `owner` keeps alive. Those of a map or a remesh cannot be written.
py::array view(const std::vector<Vec3>& rows, const py::handle& owner, Access access = Access::Read);
py::array view(const std::vector<Triangle>& rows, const py::handle& owner, Access access = Access::Read);
py::array view(const std::vector<std::array<int, 2>>& rows, const py::handle& owner, Access access = Access::Read);
py::array view(const std::vector<int>& values, const py::handle& owner, Access access = Access::Read);
py::array view(const std::vector<double>& values, const py::handle& owner, Access access = Access::Read);
py::array view(const std::vector<Complex>& values, const py::handle& owner, Access access = Access::Read);
py::array view(const std::vector<std::array<Complex, 3>>& rows, const py::handle& owner, Access access = Access::Read);

/// An array that owns the vector's memory.
template <class Vector>
py::array take(Vector&& values) {
  using Owned = std::decay_t<Vector>;
  auto* owned = new Owned(std::forward<Vector>(values));
  const py::capsule owner(owned, [](void* p) { delete static_cast<Owned*>(p); });
  return view(*owned, owner, Access::Write);
}
/// (positions, faces).
py::tuple arrays_of(Mesh mesh);

}  // namespace gsp::python

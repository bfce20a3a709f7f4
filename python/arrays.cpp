#include "python/arrays.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>

#include "mesh/topology.h"

namespace gsp::python {

namespace {

std::string shape_of(const py::array& array) { return py::str(array.attr("shape")); }

/// As an array of C order with elements of T, whatever it was; the kinds that are taken are NumPy's letters.
template <class T>
py::array_t<T, py::array::c_style> converted(const py::object& object, const char* kinds, const char* what) {
  const py::array array(object);
  if (!std::strchr(kinds, array.dtype().kind()))
    throw py::type_error(std::string(what) + " cannot be of dtype " + std::string(py::str(array.dtype())));
  return py::array_t<T, py::array::c_style | py::array::forcecast>(array);
}

void require_rows(const py::array& array, py::ssize_t columns, const char* what) {
  if (array.ndim() != 2 || array.shape(1) != columns)
    throw py::value_error(std::string(what) + " has shape " + shape_of(array) + ", not (n, " + std::to_string(columns) +
                          ")");
}

/// Numbers that an int holds; others become -1, which no vertex has either.
template <std::size_t N>
std::vector<std::array<int, N>> rows_of(const py::object& object, const char* what) {
  const auto array = converted<std::int64_t>(object, "iu", what);
  require_rows(array, N, what);
  std::vector<std::array<int, N>> rows(array.shape(0));
  const std::int64_t* next = array.data();
  for (auto& row : rows)
    for (int& value : row) {
      value = *next == static_cast<int>(*next) ? static_cast<int>(*next) : -1;
      ++next;
    }
  return rows;
}

template <class T>
py::array view_of(const void* memory, std::vector<py::ssize_t> shape, const py::handle& owner, Access access) {
  py::array_t<T> array(std::move(shape), static_cast<const T*>(memory), owner);
  if (access == Access::Read) array.attr("flags").attr("writeable") = false;
  return array;
}

}  // namespace

std::vector<Vec3> positions_of(const py::object& positions) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  const auto array = converted<double>(positions, "fiu", "positions");
  require_rows(array, 3, "positions");
  std::vector<Vec3> rows(array.shape(0));
  if (!rows.empty()) std::memcpy(rows.data()->data(), array.data(), rows.size() * sizeof(Vec3));
  return rows;
}

std::vector<Triangle> triangles_of(const py::object& rows, const char* what) { return rows_of<3>(rows, what); }

std::vector<std::array<int, 2>> pairs_of(const py::object& rows, const char* what) { return rows_of<2>(rows, what); }

Mesh mesh_of(const py::object& positions, const py::object& faces) {
  Mesh mesh{positions_of(positions), triangles_of(faces, "faces")};
  require_indices(mesh);
  return mesh;
}

std::vector<double> numbers_of(const py::object& values, const char* what) {
  const auto array = converted<double>(values, "fiu", what);
  if (array.ndim() != 1) throw py::value_error(std::string(what) + " has shape " + shape_of(array) + ", not (n,)");
  return {array.data(), array.data() + array.size()};
}

Bytes bytes_of(const py::object& buffer, std::size_t most) {
  if (!PyObject_CheckBuffer(buffer.ptr())) throw py::type_error("a stream is bytes, or what has their buffer");
  const py::buffer_info info = py::reinterpret_borrow<py::buffer>(buffer).request();
  if (info.itemsize != 1 || info.ndim != 1 || info.strides[0] != 1)
    throw py::value_error("a stream is a contiguous buffer of single bytes");
  const auto* first = static_cast<const std::uint8_t*>(info.ptr);
  return {first, first + std::min(most, static_cast<std::size_t>(info.size))};
}

py::bytes to_bytes(const Bytes& bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

py::array view(const std::vector<Vec3>& rows, const py::handle& owner, Access access) {
  return view_of<double>(rows.data(), {static_cast<py::ssize_t>(rows.size()), 3}, owner, access);
}
py::array view(const std::vector<Triangle>& rows, const py::handle& owner, Access access) {
  return view_of<int>(rows.data(), {static_cast<py::ssize_t>(rows.size()), 3}, owner, access);
}
py::array view(const std::vector<std::array<int, 2>>& rows, const py::handle& owner, Access access) {
  return view_of<int>(rows.data(), {static_cast<py::ssize_t>(rows.size()), 2}, owner, access);
}
py::array view(const std::vector<int>& values, const py::handle& owner, Access access) {
  return view_of<int>(values.data(), {static_cast<py::ssize_t>(values.size())}, owner, access);
}
py::array view(const std::vector<double>& values, const py::handle& owner, Access access) {
  return view_of<double>(values.data(), {static_cast<py::ssize_t>(values.size())}, owner, access);
}
py::array view(const std::vector<Complex>& values, const py::handle& owner, Access access) {
  return view_of<Complex>(values.data(), {static_cast<py::ssize_t>(values.size())}, owner, access);
}
py::array view(const std::vector<std::array<Complex, 3>>& rows, const py::handle& owner, Access access) {
  return view_of<Complex>(rows.data(), {static_cast<py::ssize_t>(rows.size()), 3}, owner, access);
}

py::tuple arrays_of(Mesh mesh) { return py::make_tuple(take(std::move(mesh.positions)), take(std::move(mesh.faces))); }

}  // namespace gsp::python

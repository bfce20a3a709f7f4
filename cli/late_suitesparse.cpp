// Functions of UMFPACK and CHOLMOD under their own names, linked into the program in the libraries' place: the first
// call loads them. They bring OpenBLAS along, which maps over 100 MB as it is loaded and waits for ever where it
// cannot, so commands that solve nothing do without. The headers check the types; a function that is missing here is
// found in the libraries themselves, which the program then loads as it starts (tests/cli looks for that).
#include <dlfcn.h>
#include <stdlib.h>

#include <cholmod.h>
#include <umfpack.h>

#include <cstddef>
#include <string>
#include <type_traits>

#include "mesh/error.h"
#include "param/linear/address_space.h"

namespace gsp {

namespace {

/// What the libraries and the first buffer of OpenBLAS 0.3.21 map.
constexpr std::size_t kLibraryMemory = std::size_t{208} << 20;

/// Global, so that OpenBLAS is found by name (param/linear/sparse_solver.cpp).
void* open_library(const char* file) {
  require_address_space(kLibraryMemory);
  setenv("OPENBLAS_NUM_THREADS", "1", 0);  // else it starts threads that are never used
  void* const library = dlopen(file, RTLD_NOW | RTLD_GLOBAL);
  if (!library) throw Error(Cause::SolverFailed, std::string("a library of the solver is not there: ") + dlerror());
  return library;
}

void* umfpack() {
  static void* const library = open_library(GSP_UMFPACK_FILE);
  return library;
}

void* cholmod() {
  static void* const library = open_library(GSP_CHOLMOD_FILE);
  return library;
}

template <class Function>
Function* find(void* library, const char* name) {
  void* const symbol = dlsym(library, name);
  if (!symbol) throw Error(Cause::SolverFailed, std::string("the solver's library has no ") + name);
  return reinterpret_cast<Function*>(symbol);
}

}  // namespace

}  // namespace gsp

#define GSP_LATE(library, result, name, parameters, arguments)                                          \
  extern "C" result name parameters {                                                                   \
    static const auto real = gsp::find<std::remove_reference_t<decltype(name)>>(gsp::library(), #name); \
    return real arguments;                                                                              \
  }

GSP_LATE(umfpack, void, umfpack_di_defaults, (double* control), (control))
GSP_LATE(umfpack, void, umfpack_zi_defaults, (double* control), (control))
GSP_LATE(umfpack, void, umfpack_di_free_symbolic, (void** symbolic), (symbolic))
GSP_LATE(umfpack, void, umfpack_zi_free_symbolic, (void** symbolic), (symbolic))
GSP_LATE(umfpack, void, umfpack_di_free_numeric, (void** numeric), (numeric))
GSP_LATE(umfpack, void, umfpack_zi_free_numeric, (void** numeric), (numeric))
GSP_LATE(umfpack, int, umfpack_di_symbolic,
         (int rows, int columns, const int* starts, const int* indices, const double* values, void** symbolic,
          const double* control, double* info),
         (rows, columns, starts, indices, values, symbolic, control, info))
GSP_LATE(umfpack, int, umfpack_zi_symbolic,
         (int rows, int columns, const int* starts, const int* indices, const double* real_parts,
          const double* imaginary, void** symbolic, const double* control, double* info),
         (rows, columns, starts, indices, real_parts, imaginary, symbolic, control, info))
GSP_LATE(umfpack, int, umfpack_di_numeric,
         (const int* starts, const int* indices, const double* values, void* symbolic, void** numeric,
          const double* control, double* info),
         (starts, indices, values, symbolic, numeric, control, info))
GSP_LATE(umfpack, int, umfpack_zi_numeric,
         (const int* starts, const int* indices, const double* real_parts, const double* imaginary, void* symbolic,
          void** numeric, const double* control, double* info),
         (starts, indices, real_parts, imaginary, symbolic, numeric, control, info))
GSP_LATE(umfpack, int, umfpack_di_solve,
         (int system, const int* starts, const int* indices, const double* values, double* x, const double* b,
          void* numeric, const double* control, double* info),
         (system, starts, indices, values, x, b, numeric, control, info))
GSP_LATE(umfpack, int, umfpack_zi_solve,
         (int system, const int* starts, const int* indices, const double* real_parts, const double* imaginary,
          double* x_real, double* x_imaginary, const double* b_real, const double* b_imaginary, void* numeric,
          const double* control, double* info),
         (system, starts, indices, real_parts, imaginary, x_real, x_imaginary, b_real, b_imaginary, numeric, control,
          info))
GSP_LATE(cholmod, int, cholmod_start, (cholmod_common * common), (common))
GSP_LATE(cholmod, int, cholmod_finish, (cholmod_common * common), (common))
GSP_LATE(cholmod, cholmod_factor*, cholmod_analyze, (cholmod_sparse * matrix, cholmod_common* common), (matrix, common))
GSP_LATE(cholmod, int, cholmod_factorize_p,
         (cholmod_sparse * matrix, double* beta, int* columns, std::size_t count, cholmod_factor* factor,
          cholmod_common* common),
         (matrix, beta, columns, count, factor, common))
GSP_LATE(cholmod, cholmod_dense*, cholmod_solve,
         (int system, cholmod_factor* factor, cholmod_dense* b, cholmod_common* common), (system, factor, b, common))
GSP_LATE(cholmod, int, cholmod_free_factor, (cholmod_factor * *factor, cholmod_common* common), (factor, common))
GSP_LATE(cholmod, int, cholmod_free_dense, (cholmod_dense * *dense, cholmod_common* common), (dense, common))

#include "param/linear/late_suitesparse.h"

#ifdef GSP_SUITESPARSE

#include <dlfcn.h>
#include <sys/mman.h>

#include <cholmod.h>
#include <umfpack.h>

#include <cstddef>
#include <new>
#include <string>
#include <type_traits>

#include "mesh/error.h"

namespace gsp {

namespace {

/// OpenBLAS 0.3.21 maps 128 MiB for each thread that calls it, and tries for ever where the system refuses.
constexpr std::size_t kBlasMemory = std::size_t{144} << 20;
/// With the libraries themselves, 54 MiB.
constexpr std::size_t kLibraryMemory = kBlasMemory + (std::size_t{64} << 20);

void require_memory(std::size_t bytes) {
  void* room = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (room == MAP_FAILED) throw std::bad_alloc();
  ::munmap(room, bytes);
}

/// Global, so that OpenBLAS is found by name (sparse_solver.cpp).
void* open_library(const char* file) {
  require_memory(kLibraryMemory);
  void* library = ::dlopen(file, RTLD_NOW | RTLD_GLOBAL);
  if (!library) throw Error(Cause::SolverFailed, std::string("a library of the solver is not there: ") + ::dlerror());
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
  void* symbol = ::dlsym(library, name);
  if (!symbol) throw Error(Cause::SolverFailed, std::string("the solver's library has no ") + name);
  return reinterpret_cast<Function*>(symbol);
}

}  // namespace

void load_suitesparse() {
  umfpack();
  cholmod();
}

}  // namespace gsp

// What Eigen calls, under the names of the libraries, in whose place it is linked. The headers check the types.
#define GSP_LATE(library, result, name, parameters, arguments)                                          \
  extern "C" result name parameters {                                                                   \
    static const auto real = gsp::find<std::remove_reference_t<decltype(name)>>(gsp::library(), #name); \
    return real arguments;                                                                              \
  }
// The same for what calls the BLAS.
#define GSP_LATE_BLAS(library, result, name, parameters, arguments)                                     \
  extern "C" result name parameters {                                                                   \
    static const auto real = gsp::find<std::remove_reference_t<decltype(name)>>(gsp::library(), #name); \
    gsp::require_memory(gsp::kBlasMemory);                                                              \
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
GSP_LATE_BLAS(umfpack, int, umfpack_di_numeric,
              (const int* starts, const int* indices, const double* values, void* symbolic, void** numeric,
               const double* control, double* info),
              (starts, indices, values, symbolic, numeric, control, info))
GSP_LATE_BLAS(umfpack, int, umfpack_zi_numeric,
              (const int* starts, const int* indices, const double* real_parts, const double* imaginary, void* symbolic,
               void** numeric, const double* control, double* info),
              (starts, indices, real_parts, imaginary, symbolic, numeric, control, info))
GSP_LATE_BLAS(umfpack, int, umfpack_di_solve,
              (int system, const int* starts, const int* indices, const double* values, double* x, const double* b,
               void* numeric, const double* control, double* info),
              (system, starts, indices, values, x, b, numeric, control, info))
GSP_LATE_BLAS(umfpack, int, umfpack_zi_solve,
              (int system, const int* starts, const int* indices, const double* real_parts, const double* imaginary,
               double* x_real, double* x_imaginary, const double* b_real, const double* b_imaginary, void* numeric,
               const double* control, double* info),
              (system, starts, indices, real_parts, imaginary, x_real, x_imaginary, b_real, b_imaginary, numeric,
               control, info))
GSP_LATE(cholmod, int, cholmod_start, (cholmod_common * common), (common))
GSP_LATE(cholmod, int, cholmod_finish, (cholmod_common * common), (common))
GSP_LATE(cholmod, cholmod_factor*, cholmod_analyze, (cholmod_sparse * matrix, cholmod_common* common), (matrix, common))
GSP_LATE_BLAS(cholmod, int, cholmod_factorize_p,
              (cholmod_sparse * matrix, double* beta, int* columns, std::size_t count, cholmod_factor* factor,
               cholmod_common* common),
              (matrix, beta, columns, count, factor, common))
GSP_LATE_BLAS(cholmod, cholmod_dense*, cholmod_solve,
              (int system, cholmod_factor* factor, cholmod_dense* b, cholmod_common* common),
              (system, factor, b, common))
GSP_LATE(cholmod, int, cholmod_free_factor, (cholmod_factor * *factor, cholmod_common* common), (factor, common))
GSP_LATE(cholmod, int, cholmod_free_dense, (cholmod_dense * *dense, cholmod_common* common), (dense, common))

#else

namespace gsp {

void load_suitesparse() {}

}  // namespace gsp

#endif

/// BLAS level 3 for one vector, by level 2.
///
/// MUMPS solves with its factors by `dgemm` and `dtrsm` for any number of right-hand sides. With one of them
/// OpenBLAS copies each block of the factors into its own layout, which costs several times the product: in a
/// coupled casting a tenth of the whole run. The functions here stand before those of the library, as the
/// linker finds them first; they hand one vector to `dgemv` and `dtrsv`, and all else to the library. Nothing
/// calls them by name: the build asks the linker for them (decision 0097).
#include <dlfcn.h>
#include <petscsys.h>

#include <cctype>

namespace {

using Int = PetscBLASInt;

constexpr Int k_one = 1;

bool is(const char* option, char letter) {
  return std::toupper(static_cast<unsigned char>(*option)) == letter;
}

using MatrixProduct = void(const char*, const char*, const Int*, const Int*, const Int*, const double*,
                           const double*, const Int*, const double*, const Int*, const double*, double*,
                           const Int*);
using TriangularSolution = void(const char*, const char*, const char*, const char*, const Int*, const Int*,
                                const double*, const double*, const Int*, double*, const Int*);

/// The function of the library that one of this file stands before.
template <class Function>
Function* behind(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

void dgemv_(const char* trans, const Int* m, const Int* n, const double* alpha, const double* a,
            const Int* lda, const double* x, const Int* incx, const double* beta, double* y, const Int* incy);
void dtrsv_(const char* uplo, const char* trans, const char* diag, const Int* n, const double* a,
            const Int* lda, double* x, const Int* incx);

/// C = alpha op(A) op(B) + beta C.
__attribute__((visibility("default"))) void dgemm_(const char* transa, const char* transb, const Int* m,
                                                   const Int* n, const Int* k, const double* alpha,
                                                   const double* a, const Int* lda, const double* b,
                                                   const Int* ldb, const double* beta, double* c,
                                                   const Int* ldc) {
  // With k = 0 level 3 still scales C, and level 2 returns at once.
  if (*n == 1 && *k > 0) {
    const bool plain = is(transa, 'N');
    // The column of op(B) lies in a column of B or in a row of it.
    dgemv_(transa, plain ? m : k, plain ? k : m, alpha, a, lda, b, is(transb, 'N') ? &k_one : ldb, beta, c,
           &k_one);
    return;
  }
  static MatrixProduct* const library = behind<MatrixProduct>("dgemm_");
  library(transa, transb, m, n, k, alpha, a, lda, b, ldb, beta, c, ldc);
}

/// B = alpha op(A)⁻¹ B, or alpha B op(A)⁻¹.
__attribute__((visibility("default"))) void dtrsm_(const char* side, const char* uplo, const char* transa,
                                                   const char* diag, const Int* m, const Int* n,
                                                   const double* alpha, const double* a, const Int* lda,
                                                   double* b, const Int* ldb) {
  if (*n == 1 && is(side, 'L') && *alpha == 1) {
    dtrsv_(uplo, transa, diag, m, a, lda, b, &k_one);
    return;
  }
  static TriangularSolution* const library = behind<TriangularSolution>("dtrsm_");
  library(side, uplo, transa, diag, m, n, alpha, a, lda, b, ldb);
}

}  // extern "C"

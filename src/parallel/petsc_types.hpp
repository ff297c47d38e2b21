/// The names of PETSc's objects without its headers, for headers that hand them on. A file that calls PETSc
/// includes PETSc's own headers too; a PETSc whose types differ does not compile there.
#pragma once

typedef struct _p_Mat* Mat;
typedef struct _p_Vec* Vec;
typedef struct _p_KSP* KSP;
typedef struct _p_PC* PC;
typedef struct _p_MatNullSpace* MatNullSpace;
typedef int PetscInt;

/// Laws with the generic interface of MFront (version 1 of its API: TFEL 4 and newer): an entry point that
/// takes the structure of pointers that MGIS calls mgis_bv_BehaviourDataView, and symbols that describe the
/// law.
///
/// The law is one of infinitesimal strain, `Tridimensional` whatever the analysis, and isotropic. Tensors are
/// 11, 22, 33, √2 12, √2 13, √2 23. The temperature is the first external state variable. A state variable
/// ElasticStrain starts with the elastic strain that a point has when it becomes solid, else state starts at
/// zero or as the material file says.
/// Source: documentation of MFront's generic interface and of MGIS (T. Helfer and others).
#pragma once

#include <memory>

#include "material/external_law.hpp"
#include "material/outside/shared_object.hpp"

namespace solidus::material {

/// Throws InputError with file and symbol: a symbol that is missing, a law that is none of infinitesimal
/// strain, numbers that the library asks for and the material file does not give.
std::shared_ptr<const ExternalLibrary> make_mfront_library(const SharedObject& object,
                                                           const ExternalData& data);

}  // namespace solidus::material

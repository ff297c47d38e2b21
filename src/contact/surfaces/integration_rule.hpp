/// The rules by which points of contact are placed on the slave's faces.
#pragma once

namespace solidus::contact {

enum class IntegrationRule {
  automatic,  ///< segments where partners stay, Gauss points where they do not (default)
  segments,  ///< slave faces cut where master faces begin and end, Gauss points in each piece; where partners
             ///< do not stay means over cells of the faces (segment_kinematics.hpp)
  nodal,     ///< at the slave's nodes with the weights ∫ N_a dA
  gauss,     ///< Gauss points of the slave's faces, whatever the master
  mortar     ///< means of `segments` around the slave's nodes (nodal_means.hpp)
};

}  // namespace solidus::contact

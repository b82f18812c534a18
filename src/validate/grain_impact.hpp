#pragma once
#include <string>
#include <vector>

namespace livebed::validate {

/// What is left of the motion of a sphere after an oblique impact on a plane.
struct Rebound {
  double tangential_restitution = 0;  ///< of the velocity along the plane [-]
  double spin = 0;                    ///< [1/s], negative as in the table
  double contact_angle = 0;           ///< of the contact point's velocity, from the normal [degrees]
};

/// Test 4 of Chung and Ooi (2011), Granular Matter 13, 643: a sphere of aluminium oxide, 5 mm, at 3.9 m/s, friction
/// 0.092, restitution 0.98.  angle: from the normal [degrees].  shear_ratio: tangential over normal spring [-].
Rebound run_oblique_impact(double angle, double shear_ratio);

/// The points of one quantity of data/dem_chung_ooi_test4.csv.
struct ImpactData {
  std::vector<double> angle, value;
};
ImpactData impact_data(const std::string& series, const std::string& quantity);

}  // namespace livebed::validate

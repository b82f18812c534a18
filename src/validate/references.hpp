#pragma once
#include <string_view>

/// Tables of data/ that flows and grains are held against, with their source headers; part of the program.
namespace livebed::validate {

extern const std::string_view ghia_u, ghia_v;                               ///< data/ghia1982_cavity_u.csv, _v.csv
extern const std::string_view channel_dns;                                  ///< data/channel_dns_retau180.csv
extern const std::string_view cylinder_laminar;                             ///< data/cylinder_laminar.csv
extern const std::string_view step_friction, step_pressure, step_profiles;  ///< data/bfs_driver_seegmiller_*.csv
extern const std::string_view sheet_flow_solid, sheet_flow_speed;           ///< data/sheetflow_revilbaudard2015_*.csv
extern const std::string_view sedfoam_depth;                                ///< data/sedfoam_kepsilon_livebed_depth.csv
extern const std::string_view mao_case, mao_paper_case;                     ///< cases/mao, cases/mao-mbs2d
extern const std::string_view oblique_impact;                               ///< data/dem_chung_ooi_test4.csv

}  // namespace livebed::validate

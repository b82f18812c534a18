#include "case/faults.hpp"

#include <gtest/gtest.h>

#include "base/fault.hpp"
#include "case/read.hpp"

/// Every way we know to write a bad case file, each answered by name and place.
namespace livebed::casefile {
namespace {

/// What reading a text complains about; empty when it is fine.
std::string complaint(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    read_text(text, "bad.toml", overrides);
  } catch (const base::Fault& fault) {
    EXPECT_EQ(fault.code(), base::Exit::invalid_case);
    return fault.what();
  }
  return "";
}

struct Bad {
  const char* kind;
  const char* text;      ///< appended to a good file of two lines
  const char* expected;  ///< the one fault told
};

void PrintTo(const Bad& bad, std::ostream* out) { *out << bad.kind; }

const char* good = "[current]\ntheta = 0.33\n";

class BadCase : public testing::TestWithParam<Bad> {};

TEST_P(BadCase, is_answered_by_name) {
  const std::string expected = std::string(GetParam().expected) + "\n1 fault, nothing was run";
  EXPECT_EQ(complaint(std::string(good) + GetParam().text), expected);
}

// Line 3 is the first one of the appended text.
const Bad bad_cases[] = {
    // what the file says
    {"syntax", "[flow\n", "bad.toml:3: not TOML: Error while parsing table header: expected ']', saw '\\n'"},
    {"no_value", "profile =\n", "bad.toml:3: not TOML: Error while parsing key-value pair: expected value, saw '\\n'"},
    {"key_twice", "theta = 0.4\n", "bad.toml:3: theta is given twice"},
    {"table_twice", "[bed]\ncount = 9\n[current]\nprofile = \"rough\"\n", "bad.toml:5: current is given twice"},
    {"unknown_key", "[coupling]\ndrg = \"paper\"\n",
     "bad.toml:4: unknown key coupling.drg; did you mean coupling.drag (paper, di_felice, gidaspow, rong)?"},
    {"key_in_the_wrong_table", "[flow]\nrestitution = 0.5\n",
     "bad.toml:4: unknown key flow.restitution; did you mean contact.restitution?"},
    {"steady_projection", "[flow]\nsteady = true\n",
     "bad.toml:4: flow.steady = true needs flow.algorithm = \"simple\": the projection has no steady mode"},
    {"wall_without_a_number", "[bed]\nwalls = \"0.1 0.2, 0.3\"\n",
     "bad.toml:4: bed.walls: \" 0.3\" is no point: give x and y in metres, as in \"0.1 0.3, 0.1 0\""},
    {"wall_of_one_point", "[bed]\nwalls = \"0.1 0.2, 0.3 0; 0.4 0\"\n",
     "bad.toml:4: bed.walls: \" 0.4 0\" is no line: it needs two points or more"},
    {"wall_of_equal_points", "[bed]\nwalls = \"0.1 0.2, 0.1 0.2\"\n",
     "bad.toml:4: bed.walls: the point 0.1 0.2 stands twice in a row"},
    {"unknown_key_like_none", "speed_of_light = 3e8\n", "bad.toml:3: unknown key current.speed_of_light"},
    {"unknown_table", "[grians]\ndiameter = 1\n", "bad.toml:3: unknown table [grians]; did you mean [grains]?"},
    {"nested_table", "[flow.current]\ntheta = 0.3\n",
     "bad.toml:3: unknown table [flow.current]; did you mean [current]?"},
    {"table_in_a_key", "[pipe.diameter]\nx = 1\n",
     "bad.toml:3: pipe.diameter = {...} is a table; a length (m, cm, mm) is expected"},
    {"list_of_tables", "[[pipe]]\nx = 0.2\n", "bad.toml:3: pipe = [...] is an array; pipe is a table of keys"},
    {"computed_key", "[pipe]\ny = 0.1\n",
     "bad.toml:4: pipe.y cannot be given: it is computed (centre above the floor of the box, at the nominal bed "
     "level)"},
    // types
    {"number_for_word", "[flow]\nclosure = 3\n",
     "bad.toml:4: flow.closure = 3 is a number; one of k_epsilon, k_epsilon_realizable, k_omega, k_omega_sst, laminar "
     "is "
     "expected"},
    {"array_for_number", "[flow]\ncourant = [0.5]\n",
     "bad.toml:4: flow.courant = [...] is an array; a pure number (or %) is expected"},
    {"date_for_number", "[time]\nend = 2020-01-01\n",
     "bad.toml:4: time.end = 2020-01-01 is a date or time; a time (s, ms, us, min) is expected"},
    {"boolean_for_number", "[grains]\nspread = true\n",
     "bad.toml:4: grains.spread = true is a boolean; a pure number (or %) is expected"},
    {"string_for_flag", "[pipe]\npresent = \"yes\"\n",
     "bad.toml:4: pipe.present = \"yes\" is a string; true or false is expected"},
    {"number_for_text", "[case]\ntitle = 3\n", "bad.toml:4: case.title = 3 is a number; a string is expected"},
    {"fraction_for_count", "[bed]\ncount = 10.5\n", "bad.toml:4: bed.count = 10.5 is not a whole number"},
    {"string_for_count", "[bed]\nseed = \"1\"\n",
     "bad.toml:4: bed.seed = \"1\" is a string; a whole number is expected"},
    {"word_misspelt", "[flow]\nclosure = \"k-epsilon\"\n",
     "bad.toml:4: flow.closure = \"k-epsilon\" is not one of k_epsilon, k_epsilon_realizable, k_omega, k_omega_sst, "
     "laminar; "
     "did you mean k_epsilon?"},
    {"word_with_underscore", "[coupling]\nmode = \"two_way\"\n",
     "bad.toml:4: coupling.mode = \"two_way\" is not one of none, one-way, two-way; did you mean two-way?"},
    {"word_like_none", "[coupling]\nvoidage = \"sometimes\"\n",
     "bad.toml:4: coupling.voidage = \"sometimes\" is not one of off, on"},
    // units
    {"wrong_unit", "[grains]\ndiameter = \"0.36 kg\"\n",
     "bad.toml:4: grains.diameter = \"0.36 kg\" has the wrong unit kg; a length (m, cm, mm) is expected"},
    {"wrong_unit_of_speed", "[bed]\nsettled_speed = \"1 m/s2\"\n",
     "bad.toml:4: bed.settled_speed = \"1 m/s2\" has the wrong unit m/s2; a speed (m/s, cm/s) is expected"},
    {"unit_of_a_pure_number", "[pipe]\ngap_ratio = \"1 mm\"\n",
     "bad.toml:4: pipe.gap_ratio = \"1 mm\" has the wrong unit mm; a pure number (or %) is expected"},
    {"unknown_unit", "[grains]\ndiameter = \"2 parsec\"\n",
     "bad.toml:4: grains.diameter = \"2 parsec\" has the unknown unit parsec; a length (m, cm, mm) is expected"},
    {"no_unit", "[flow]\nviscosity = \"1e-6\"\n",
     "bad.toml:4: flow.viscosity = \"1e-6\" has no unit; a kinematic viscosity (m2/s, mm2/s) is expected, or a bare "
     "number in m2/s"},
    {"no_number", "[grains]\ndensity = \"heavy\"\n",
     "bad.toml:4: grains.density = \"heavy\" is not a number with a unit; a density (kg/m3, g/cm3) is expected"},
    // ranges
    {"above_range", "[contact]\nrestitution = 1.4\n", "bad.toml:4: contact.restitution = 1.4 is outside (0, 1]"},
    {"open_end_of_range", "[contact]\nrestitution = 0\n", "bad.toml:4: contact.restitution = 0 is outside (0, 1]"},
    {"below_range", "[flow]\nviscosity = -1e-6\n", "bad.toml:4: flow.viscosity = -1e-06 is outside (0, inf) m2/s"},
    {"range_with_unit", "[grains]\ndiameter = \"-2 mm\"\n",
     "bad.toml:4: grains.diameter = \"-2 mm\" is outside [1e-06, 1] m"},
    {"count_below_range", "[bed]\ncount = -5\n", "bad.toml:4: bed.count = -5 is outside [0, 100000000]"},
    {"steps_below_range", "[contact]\nsteps = 2\n", "bad.toml:4: contact.steps = 2 is outside [5, 10000]"},
    {"not_a_number", "[flow]\ndensity = nan\n", "bad.toml:4: flow.density = nan is not a finite number"},
    {"infinite", "[time]\nend = inf\n", "bad.toml:4: time.end = inf is not a finite number"},
    {"infinite_with_unit", "[time]\nend = \"inf s\"\n", "bad.toml:4: time.end = \"inf s\" is not a finite number"},
    {"too_large_for_a_double", "[time]\nend = \"1e400 s\"\n",
     "bad.toml:4: time.end = \"1e400 s\" is not a finite number"},
    // keys that stand for one another
    {"two_currents", "mean_speed = 1\n",
     "bad.toml:3: current.theta and current.mean_speed contradict each other: give one of them"},
    {"three_currents", "mean_speed = 1\nshear_velocity = 0.1\n",
     "bad.toml:4: current.theta and current.mean_speed and current.shear_velocity contradict each other: give one of "
     "them"},
    {"stiffness_and_step", "[contact]\nstiffness = 1e3\n[time]\ngrain_step = 1e-5\n",
     "bad.toml:6: contact.stiffness and time.grain_step contradict each other: give one of them"},
    {"damping_and_restitution", "[contact]\nrestitution = 0.4\ndamping = 0.3\n",
     "bad.toml:5: contact.damping and contact.restitution contradict each other: give one of them"},
    {"count_and_thickness", "[bed]\ncount = 6240\nthickness = 0.05\n",
     "bad.toml:5: bed.thickness and bed.count contradict each other: give one of them"},
    {"two_ends", "[time]\nend = 3\nend_over_T = 3\n",
     "bad.toml:5: time.end and time.end_over_T contradict each other: give one of them"},
    // geometry
    {"pipe_through_the_inlet", "[pipe]\nx = 0.02\n",
     "bad.toml:4: pipe.x = 0.02 m with pipe.diameter = 0.05 m reaches through the inlet, x = 0"},
    {"pipe_through_the_outlet", "[pipe]\nx = 0.6\n",
     "bad.toml:4: pipe.x = 0.6 m with pipe.diameter = 0.05 m reaches through the outlet, x = 0.5 m"},
    {"pipe_through_the_top", "[pipe]\ngap_ratio = 3\n",
     "bad.toml:4: pipe.gap_ratio = 3 lifts the top of the pipe to 0.25 m, above mesh.height = 0.2 m"},
    {"pipe_through_the_floor", "[bed]\nthickness = 0.03\n[pipe]\ngap_ratio = -1\n",
     "bad.toml:6: pipe.gap_ratio = -1 sinks the pipe 0.02 m below the floor of the box; the bed is 0.03 m thick"},
    {"bed_fills_the_box", "[bed]\nthickness = 0.2\n",
     "bad.toml:4: the bed is 0.2 m thick and leaves no water in mesh.height = 0.2 m"},
    {"bed_of_half_a_grain", "[bed]\nthickness = \"1 mm\"\n",
     "bad.toml:4: bed.thickness = 0.001 m is less than one grain, grains.diameter = 0.002 m; 0 is a case without "
     "grains"},
    {"bed_of_dust", "[grains]\ndiameter = \"2 um\"\n[coupling]\nmode = \"none\"\n",
     "bad.toml:4: bed.thickness = 0.05 m needs more than 100000000 grains of 2e-06 m"},
    {"floating_grains", "[grains]\ndensity = 900\n",
     "bad.toml:4: grains.density = 900 kg/m3 does not sink in water of flow.density = 1000 kg/m3"},
    {"boulders", "[grains]\ndiameter = 0.06\n[bed]\ncount = 3\n[coupling]\nmode = \"none\"\n",
     "bad.toml:4: grains.diameter = 0.06 m leaves fewer than 10 grains in mesh.length = 0.5 m"},
    {"cells_too_wide", "[mesh]\ncell_x = \"8 mm\"\n",
     "bad.toml:4: mesh.cell_x = 0.008 m gives 6.25 cells across the pipe; 8 are needed: at most 0.00625 m"},
    {"cells_too_high", "[mesh]\ncell_y = \"7 mm\"\n",
     "bad.toml:4: mesh.cell_y = 0.007 m gives 7.14 cells across the pipe; 8 are needed: at most 0.00625 m"},
    {"cells_larger_than_the_box", "[mesh]\ncell_x = 1\n[pipe]\npresent = false\n[coupling]\nmode = \"none\"\n",
     "bad.toml:4: mesh.cell_x = 1 m leaves fewer than 4 cells in mesh.length = 0.5 m"},
    {"fine_window_outside", "[mesh]\nfine_x_to = 0.6\n",
     "bad.toml:4: mesh.fine_x_to = 0.6 m is outside the box, mesh.length = 0.5 m"},
    {"fine_window_reversed", "[mesh]\nfine_y_from = 0.1\nfine_y_to = 0.05\n",
     "bad.toml:5: mesh.fine_y_from = 0.1 m must be smaller than mesh.fine_y_to = 0.05 m"},
    {"pipe_outside_the_fine_window", "[mesh]\ngrowth = 1.05\nfine_x_from = 0.3\nfine_x_to = 0.4\n",
     "bad.toml:6: the pipe, 0.175 m to 0.225 m, leaves the fine window mesh.fine_x_from = 0.3 m to mesh.fine_x_to = "
     "0.4 m"},
    {"kernel_between_the_cells", "[coupling]\nkernel = 0.5\n[mesh]\ncell_x = 0.01\n[pipe]\npresent = false\n",
     "bad.toml:4: coupling.kernel = 0.5 reaches 0.001 m, less than 0.125 of a cell of 0.01 m: give at least "
     "0.625"},
    {"kernel_over_too_many_cells", "[coupling]\nkernel = 10\n[mesh]\ncell_x = 0.0005\n",
     "bad.toml:4: coupling.kernel = 10 reaches 0.02 m, more than 20 cells of 0.0005 m: give at most 5"},
    {"cut_beside_thickness", "[bed]\nthickness = 0.05\ncut = 0.04\n",
     "bad.toml:5: bed.cut = 0.04 m contradicts bed.thickness = 0.05 m, to which the bed is cut: it goes with "
     "bed.count"},
    {"pieces_too_short", "[bed]\npieces = 6\n",
     "bad.toml:4: bed.pieces = 6 are 41.7 grains long each; 50 are needed, so at most 5 pieces"},
    {"pieces_between_walls", "[bed]\npieces = 2\nside_walls = true\n",
     "bad.toml:4: bed.pieces = 2 fit together only without walls: remove bed.walls and bed.side_walls"},
    {"supply_between_walls", "[bed]\nsupply = \"none\"\nside_walls = true\n",
     "bad.toml:4: bed.supply other than \"periodic\" needs ends without walls: remove bed.walls and bed.side_walls"},
    {"supply_of_large_grains", "[bed]\nsupply = \"equilibrium\"\n[pipe]\nx = 0.1\n",
     "bad.toml:4: bed.supply = \"equilibrium\" takes its measure 12.5 grains behind the inlet, a quarter of the way to "
     "the pipe; at "
     "least 16 are needed: move the pipe or the outlet downstream"},
    {"pieces_of_a_file", "[bed]\npieces = 2\nfile = \"one.data\"\n",
     "bad.toml:4: bed.pieces = 2 are for a bed that is packed; bed.file gives one"},
    {"pieces_that_are_not_alike", "[bed]\npieces = 2\ncount = 6241\n",
     "bad.toml:4: bed.count = 6241 cannot be divided into bed.pieces = 2 alike"},
    {"level_beside_thickness", "[bed]\nthickness = 0.05\nlevel = 0.04\n",
     "bad.toml:5: bed.level = 0.04 m contradicts bed.thickness = 0.05 m: it goes with bed.count"},
    // sizes
    {"grading_with_one_point", "[grains]\ngrading = \"2 mm: 50 %\"\n",
     "bad.toml:4: the grading of the grains: 1 points do not make a curve; give at least two"},
    {"grading_without_units", "[grains]\ngrading = \"2: 50 %, 3: 90 %\"\n",
     "bad.toml:4: grains.grading: \"2\" is not a diameter with its unit, as in \"0.2 mm: 10 %, 0.36 mm: 50 %\""},
    {"grading_without_shares", "[grains]\ngrading = \"2 mm, 3 mm\"\n",
     "bad.toml:4: grains.grading: \"\" is not a share of the mass that passes, as in \"0.2 mm: 10 %, 0.36 mm: 50 %\""},
    {"grading_falling", "[grains]\nd10 = 3e-3\nd50 = 2e-3\nd90 = 2.5e-3\n",
     "bad.toml:5: the grading of the grains: 0.002 m, 0.5 passing, comes after 0.003 m, 0.1 passing; both must rise "
     "from point to point"},
    {"grading_too_wide", "[grains]\ngrading = \"1 mm: 0, 8 mm: 100 %\"\n",
     "bad.toml:4: the grading of the grains: the largest grain, 0.008 m, is 8 times the smallest, 0.001 m; at most 4 "
     "times are allowed: cells and lists are made for the largest, the slab for the median; make the tails shorter"},
    {"half_a_grading", "[grains]\nd50 = 2e-3\nd90 = 2.5e-3\n",
     "bad.toml:4: grains.d50 needs grains.d10 and grains.d90 beside it"},
    {"tails_of_no_grading", "[grains]\nd90 = 2.5e-3\n",
     "bad.toml:4: grains.d10 and grains.d90 belong to grains.d50, which is not given"},
    {"grading_and_diameter", "[grains]\ndiameter = 2e-3\ngrading = \"1 mm: 0, 3 mm: 100 %\"\n",
     "bad.toml:5: grains.diameter and grains.grading contradict each other: give one of them"},
    {"grading_and_spread", "[grains]\nspread = 0.1\ngrading = \"1 mm: 0, 3 mm: 100 %\"\n",
     "bad.toml:5: grains.spread and grains.grading contradict each other: give one of them"},
    // walls
    {"rough_pipe_without_roughness", "[pipe]\nwall = \"rough\"\n",
     "bad.toml:4: pipe.wall = \"rough\" needs pipe.roughness, the ks of the pipe"},
    {"roughness_of_a_smooth_pipe", "[pipe]\nroughness = \"1 mm\"\n",
     "bad.toml:4: pipe.roughness = 0.001 m contradicts pipe.wall, which is not \"rough\""},
    {"roughness_of_a_smooth_floor", "[flow]\nfloor = \"smooth\"\nfloor_roughness = \"1 mm\"\n",
     "bad.toml:5: flow.floor_roughness = 0.001 m contradicts flow.floor, which is not \"rough\""},
    {"roughness_of_a_smooth_current", "roughness = \"5 mm\"\nprofile = \"smooth\"\n",
     "bad.toml:3: current.roughness = 0.005 m contradicts current.profile = \"smooth\""},
    {"roughness_deeper_than_the_water", "roughness = \"20 cm\"\n",
     "bad.toml:3: current.roughness = 0.2 m is larger than the water is deep, 0.15 m"},
    // time
    {"flow_step_below_grain_step", "[flow]\nmax_step = \"1 us\"\n",
     "bad.toml:4: flow.max_step = 1e-06 s is shorter than the grains' step, 1e-05 s"},
    {"time_scale_without_a_pipe", "[time]\nend_over_T = 8\n[pipe]\npresent = false\n",
     "bad.toml:4: time.end_over_T = 8 needs a pipe and grains: without them there is no scour time scale; give "
     "time.end"},
    {"equilibrium_without_a_pipe", "[time]\nstop_at_equilibrium = true\n[pipe]\npresent = false\n",
     "bad.toml:4: time.stop_at_equilibrium needs a pipe and grains: without them nothing is scoured"},
    {"edited_resolved_case", "[derived]\nbed.count = 3\n",
     "bad.toml:4: derived.bed.count = 3 contradicts the keys, which give 6439; remove the table [derived]"},
    {"unknown_derived_number", "[derived]\ntime.ende = 3.0\n",
     "bad.toml:4: unknown derived number time.ende; did you mean time.end?"},
};

INSTANTIATE_TEST_SUITE_P(faults, BadCase, testing::ValuesIn(bad_cases),
                         [](const auto& bad) { return std::string(bad.param.kind); });

TEST(faults, a_good_file_has_none) { EXPECT_EQ(complaint(good), ""); }

TEST(faults, a_missing_current_is_told_even_of_an_empty_file) {
  EXPECT_EQ(complaint(""),
            "bad.toml: missing: give one of current.theta, current.mean_speed, current.shear_velocity\n"
            "1 fault, nothing was run");
}

TEST(faults, are_told_all_at_once_in_the_order_of_the_lines) {
  EXPECT_EQ(complaint("preset = \"paper\"\n"
                      "[grains]\n"
                      "diameter = \"2 kg\"\n"
                      "[pipe]\n"
                      "x = 0.49\n"
                      "[current]\n"
                      "thetta = 0.3\n"
                      "theta = 0.3\n",
                      {"flow.courant=7", "bed.cuont=3"}),
            "bad.toml:1: preset = \"paper\" is not one of livebed, mbs2d\n"
            "bad.toml:3: grains.diameter = \"2 kg\" has the wrong unit kg; a length (m, cm, mm) is expected\n"
            "bad.toml:5: pipe.x = 0.49 m with pipe.diameter = 0.05 m reaches through the outlet, x = 0.5 m\n"
            "bad.toml:7: unknown key current.thetta; did you mean current.theta?\n"
            "--set: flow.courant = 7 is outside (0, 1]\n"
            "--set: unknown key bed.cuont; did you mean bed.count?\n"
            "6 faults, nothing was run");
}

TEST(faults, of_the_command_line_name_it) {
  EXPECT_EQ(complaint(good, {"bed.count"}), "--set: \"bed.count\" is not table.key=value\n1 fault, nothing was run");
  EXPECT_EQ(complaint(good, {"bed.seed=1", "bed.seed=2"}), "--set: bed.seed is given twice\n1 fault, nothing was run");
  EXPECT_EQ(complaint(good, {"preset=mbs2"}),
            "--set: preset = \"mbs2\" is not one of livebed, mbs2d; did you mean mbs2d?\n1 fault, nothing was run");
  EXPECT_EQ(complaint(good, {"current.mean_speed=1", "current.shear_velocity=1"}),
            "--set: current.mean_speed and current.shear_velocity contradict each other: give one of them\n"
            "1 fault, nothing was run");
  EXPECT_EQ(complaint(good, {"pipe.y=1"}),
            "--set: pipe.y cannot be given: it is computed (centre above the floor of the box, at the nominal bed "
            "level)\n1 fault, nothing was run");
}

TEST(faults, a_current_too_weak_for_its_log_law_is_told) {
  EXPECT_EQ(complaint("[current]\nshear_velocity = 1e-9\nprofile = \"smooth\"\n"),
            "bad.toml:2: the current is too weak for its log law: theta = 3.09e-17, u* = 1e-09 m/s, mean speed 0 m/s\n"
            "1 fault, nothing was run");
}

TEST(faults, a_setting_that_is_not_text_is_told) {
  EXPECT_EQ(complaint(good, {"case.title=\xff\xfe"}), "--set: case.title is not UTF-8 text\n1 fault, nothing was run");
}

TEST(faults, of_a_wrong_value_bring_no_others_along) {
  // The bad diameter must not be replaced by a default that then collides with the kernel or the thickness.
  EXPECT_EQ(complaint(std::string(good) + "[grains]\ndiameter = \"2 s\"\n[bed]\nthickness = \"1 mm\"\n"),
            "bad.toml:4: grains.diameter = \"2 s\" has the wrong unit s; a length (m, cm, mm) is expected\n"
            "1 fault, nothing was run");
}

TEST(faults, suggest_only_what_is_near) {
  const std::vector<std::string> words{"hybrid", "bounded"};
  EXPECT_EQ(nearest("hibrid", words), "hybrid");
  EXPECT_EQ(nearest("hbyrid", words), "hybrid");
  EXPECT_EQ(nearest("bound", words), "bounded");
  EXPECT_EQ(nearest("upwind", words), "");
  EXPECT_EQ(nearest("", words), "");
}

TEST(faults, of_an_unreadable_file_end_with_the_input_output_code) {
  try {
    read_case("no/such/folder.toml");
    FAIL() << "no fault";
  } catch (const base::Fault& fault) {
    EXPECT_EQ(fault.code(), base::Exit::input_output);
    EXPECT_STREQ(fault.what(), "cannot read the case file no/such/folder.toml: No such file or directory");
  }
}

}  // namespace
}  // namespace livebed::casefile

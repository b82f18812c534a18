#pragma once
#include <map>
#include <set>
#include <string>

#include "case/case.hpp"
#include "case/faults.hpp"

/// Physics across keys: what follows from the keys given, and which combinations make no sense.
namespace livebed::casefile {

/// What the reader knows about the keys besides their values.
struct Sources {
  std::map<std::string, Origin, std::less<>> origin;  ///< of every key that was given
  std::set<std::string, std::less<>> bad;             ///< keys whose value is missing or a fault already
};

/// Grain roughness of a flat bed, ks = 2.5 d.
inline constexpr double roughness_over_diameter = 2.5;
inline constexpr int most_grains = 100'000'000;
/// Fewer cells than this across the pipe cannot turn the flow round it.
inline constexpr double least_cells_across_pipe = 8;
/// A piece of a bed is at least so many grains long: shorter ones would show their repetition.
inline constexpr double least_piece = 50;
/// More cells than this inside the half-width of the transfer kernel cost more than they tell.
inline constexpr double least_kernel_in_cells = 0.125;  ///< a narrower one leaves grain and cell to chance [-]
inline constexpr double most_cells_in_kernel = 20;
/// A larger estimate of the static overlap at the bottom of the bed over d earns a note: the bed would be too soft.
inline constexpr double overlap_to_note = 0.01;
/// So does a current that comes up so fast that the pressure which speeds up the water pushes the bed along with more
/// than this share of its weight in water: half of what friction bears.
inline constexpr double push_to_note = 0.3;

/// The sieve curve of a text like "0.2 mm: 10 %, 0.36 mm: 50 %".  Throws Fault (invalid case) naming the point that
/// cannot be read; whether the curve makes sense is checked elsewhere (grains::check_grading).
grains::Grading parse_grading(std::string_view text);

/// Shortest current.rise [s] that pushes the bed with no more than push_to_note of its weight in water; 0 without a
/// bed. The pressure that makes water gather speed pushes all sand alike, as the flume's pump and its length decide,
/// not the size of the grains: scaled to the time of larger ones it can wash away the bed as a whole.
double least_rise(const Case& c);

/// Fills every derived number of a case whose given keys are set; c.given says which of the alternatives they are.
void derive(Case& c);

/// The same once the packing has shown where the bed's level truly is [m]: thickness, pipe, approaching current and
/// times follow it; the number of grains is that of the bed and counts as given from here on.
void derive_at_level(Case& c, int count, double level);

/// Adds a fault for every combination of keys that makes no sense.  Combinations with a key that is bad already are
/// passed over.
void check(const Case& c, const Sources& sources, Faults& faults);

/// What is allowed but deserves a second look, one sentence each.
std::vector<std::string> notes(const Case& c);

}  // namespace livebed::casefile

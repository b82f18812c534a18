#pragma once
#include "validate/result.hpp"

namespace livebed::validate {

/// Where the runs of the experiment are kept, from the working folder: <grain>-seed<k>, each a run folder.
inline constexpr const char* kept_scours = "runs/validate/mao";

/// The live-bed experiment of Mao (1986) with his own sand, seconds against seconds: depth in time, bed profiles.  Runs
/// that are not at their end are made or resumed; stopped by a signal, they go on at the next call and what
/// there is so far is told.  Throws Fault (signal) when that is nothing, (command line) for a seed that is none of
/// them, (input/output) when a file in seeds.folder cannot be read, and what a run throws.
Result mao(const Seeds& seeds, const Tell& tell);
/// The same with larger grains and the sand's own physics, three seeds: t/T against t/T.
Result mao_07mm(const Seeds& seeds, const Tell& tell);
Result mao_1mm(const Seeds& seeds, const Tell& tell);
Result mao_2mm(const Seeds& seeds, const Tell& tell);
/// The same with grains of 2 mm as the paper has them, preset mbs2d: t/T against t/T.
Result mao_paper(const Seeds& seeds, const Tell& tell);

}  // namespace livebed::validate

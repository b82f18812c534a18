#pragma once
#include "validate/result.hpp"

namespace livebed::validate {

/// The live-bed experiment of Mao (1986) with his own sand, seconds against seconds: depth in time, bed profiles.  Runs
/// that are not at their end are made or resumed; stopped by a signal, they go on at the next call and what
/// there is so far is told.  Throws Fault (signal) when that is nothing, (command line) for a seed that is none of
/// them, (input/output) when a file in only.folder cannot be read, and what a run throws.
Result mao(const Only& only, const Tell& tell);
/// The same with larger grains and the sand's own physics, three seeds: t/T against t/T.
Result mao_07mm(const Only& only, const Tell& tell);
Result mao_1mm(const Only& only, const Tell& tell);
Result mao_2mm(const Only& only, const Tell& tell);
/// The same with grains of 2 mm as the paper has them, preset mbs2d: t/T against t/T.
Result mao_paper(const Only& only, const Tell& tell);

}  // namespace livebed::validate

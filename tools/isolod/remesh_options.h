// What the commands that remesh have in common: their options, their input, what they say of repairs.
#pragma once

#include <cstdint>
#include <vector>

#include "isolod/arguments.h"
#include "isolod/files.h"
#include "isolod/run.h"

namespace tool {

constexpr std::uint64_t most_count = 0xffffffffu;

/// What the result shall be like, and how the program shows it.
std::vector<OptionRule> wish_rules();
/// How the work is done: for those who compare.
std::vector<OptionRule> method_rules();
/// The parts of a command's table as one.
std::vector<OptionRule> joined(const std::vector<std::vector<OptionRule>>& parts);

/// All that these options say, for one mesh of so many vertices. `--paper` and `--keep-seams` count where a command has
/// them.
RunSettings settings_from(const Arguments& arguments, std::uint64_t vertices);

/// The file of the first operand, with the density and the feature edges that the options name.
InputMesh read_input(const Arguments& arguments);

/// What was changed before the work, on standard error, so that nobody has to find out from the result. Nothing for a
/// clean input.
void print_repairs(const std::string& input, const isolod::RepairReport& repair);

}  // namespace tool

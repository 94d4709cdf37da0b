// The commands of the program, one file each. Each takes the words behind its name and gives the exit code.
#pragma once

#include "isolod/arguments.h"

namespace tool {

struct Command {
  const CommandRule& (*rule)();
  int (*run)(const Arguments& arguments);
};

const CommandRule& remesh_rule();
int command_remesh(const Arguments& arguments);

const CommandRule& lods_rule();
int command_lods(const Arguments& arguments);

const CommandRule& plan_rule();
int command_plan(const Arguments& arguments);

const CommandRule& info_rule();
int command_info(const Arguments& arguments);

const CommandRule& compare_rule();
int command_compare(const Arguments& arguments);

const CommandRule& make_rule();
int command_make(const Arguments& arguments);

const CommandRule& cut_rule();
int command_cut(const Arguments& arguments);

const CommandRule& validate_rule();
int command_validate(const Arguments& arguments);

}  // namespace tool

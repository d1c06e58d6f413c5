#pragma once
#include <string>

namespace carom {

/// Lists a file that is of no use before it has its name, for remove_unfinished(). Returns its place in the list.
int list_unfinished(const std::string& file);
/// Takes it off the list; a place of −1 is none.
void unlist_unfinished(int place);

/// Programs that were started: the same, with a place each. What draws is ended by interrupt_figures(), all others by
/// remove_unfinished() alone.
int list_program(int process, bool draws);
void unlist_program(int place);
bool figures_were_interrupted();

}  // namespace carom

#pragma once
#include <string>

namespace carom {

/// Lists a file that is of no use before it has its name, for remove_unfinished(). Returns its place in the list.
int list_unfinished(const std::string& file);
/// Takes it off the list; a place of −1 is none.
void unlist_unfinished(int place);

}  // namespace carom

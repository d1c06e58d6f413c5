#pragma once
#include <string>

namespace carom::app {

/// How this program was made: compiler, settings, and the sources if git knew them.
std::string build_words();

}  // namespace carom::app

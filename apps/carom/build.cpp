#include "build.hpp"

#include <carom_sources.hpp>

namespace carom::app {

std::string build_words() {
#ifdef __clang__
    const std::string compiler = "clang++ " __clang_version__;
#else
    const std::string compiler = "g++ " __VERSION__;
#endif
    const std::string settings = CAROM_BUILD_SETTINGS, sources = CAROM_SOURCES;
    return compiler + (settings.empty() ? "" : ", " + settings) + (sources.empty() ? "" : ", sources " + sources);
}

}  // namespace carom::app

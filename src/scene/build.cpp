#include "scene/document.hpp"

namespace carom {

void build_all(World&, const Reader&, const Json&, const Place&, std::uint64_t) {}

}  // namespace carom

#pragma once
#include "experiment.hpp"

namespace carom::app {

/// What a person had better know who starts from here: bodies that are inside one another and would collide, joints
/// that gape, chains without slack, forces that do nothing, a time to measure from where nothing is measured, angles of
/// points. `quantities`: what is looked at beside what the scene names.
std::vector<Note> notes_at_start(const Scene& scene, const World& start, std::vector<std::string> quantities = {});
/// And what of a run that came to its end, where nothing was noted of its start: a motor that stops at nothing.
std::vector<Note> notes_at_end(const World& end);

}  // namespace carom::app

#pragma once
// The engine's whole public API. The laboratory (scene files, pictures, data) is in scene.hpp and output.hpp.
#include <carom/analysis.hpp>
#include <carom/builder.hpp>
#include <carom/convergence.hpp>
#include <carom/joint.hpp>
#include <carom/random.hpp>
#include <carom/version.hpp>
#include <carom/world.hpp>

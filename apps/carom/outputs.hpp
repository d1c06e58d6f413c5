#pragma once
#include "products.hpp"

namespace carom::app {

/// Before anything is run or written: an Error if a run would write over the scene that it is one of, write a file
/// twice, or put a checkpoint in the place of something else.
void check_outputs(const std::string& scene, const Products& wanted);
/// An Error if there is no folder for the file.
void check_folder(const std::filesystem::path& file);

/// A file's name as a shell takes it, to be pasted.
std::string in_shell(const std::string& file);

}  // namespace carom::app

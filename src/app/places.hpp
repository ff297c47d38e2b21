/// Folders of results and of installed data, and the note by which a script learns the results folder.
#pragma once

#include <filesystem>

namespace solidus::app {

/// The repository that the present folder belongs to, else the present folder.
std::filesystem::path results_root();

/// Folder of the data of an installed program, share/solidus of its prefix; it need not exist.
std::filesystem::path shared_folder();

/// Tells a script where the results are: the path goes to the file that SOLIDUS_RESULTS_NOTE names, because a
/// terminal's output cannot be piped without losing the progress bar.
void note_folder(const std::filesystem::path& folder);

}  // namespace solidus::app

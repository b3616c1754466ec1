// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/job/folder/run_on_disk.hpp"

#include "coupler/protocol/failure.hpp"
#include "coupler/protocol/files/stored_file.hpp"

namespace turbidite {
namespace {

namespace fs = std::filesystem;

void put_tree_on_disk(const fs::path& folder) {
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        const fs::file_status status = entry.symlink_status();
        if (fs::is_regular_file(status) || fs::is_directory(status)) put_on_disk(entry.path());
    }
    put_on_disk(folder);
}

/// Those above may have been made with the run folder. One that cannot be opened was there before.
void put_names_on_disk(const fs::path& folder) {
    put_on_disk(folder.parent_path());
    for (fs::path above = folder.parent_path(); above.has_relative_path();) {
        above = above.parent_path();
        try {
            put_on_disk(above);
        } catch (const Failure&) {
            return;
        }
    }
}

}  // namespace

void put_run_on_disk(const RunFolder& folder) {
    put_on_disk(folder.resolved_case());
    put_on_disk(folder.record());
    for (const fs::path& tree : {folder.grains(), folder.fluid()})
        if (fs::exists(tree)) put_tree_on_disk(tree);
    // Names after contents, from inside out.
    put_on_disk(folder.root);
    put_names_on_disk(folder.root);
}

}  // namespace turbidite

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/protocol/files/run_files.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <fstream>
#include <iterator>

#include "coupler/protocol/received.hpp"

namespace turbidite {
namespace {

std::filesystem::path first_end_file(const std::filesystem::path& run) {
    return run / "logs" / "first_end";
}

}  // namespace

std::string rank_name(Role role, int rank) {
    const std::string name = role_name(role);
    return role == Role::coupler ? name : name + " rank " + std::to_string(rank);
}

std::filesystem::path log_file(const std::filesystem::path& run, Role role, int rank, int ranks) {
    const std::string number = ranks > 1 ? ".rank" + std::to_string(rank) : "";
    return run / "logs" / (role_name(role) + number + ".log");
}

std::filesystem::path wait_table_file(const std::filesystem::path& run) {
    return run / "logs" / "waits";
}

bool write_first_end(const std::filesystem::path& run, const FirstEnd& end) {
    const std::string text =
        std::to_string(static_cast<int>(end.code)) + "\n" + end.who + "\n" + end.what + "\n";
    // Exclusively: of programs that end one after the other, the first is the cause.
    const int file = open(first_end_file(run).c_str(), O_WRONLY | O_CREAT | O_EXCL, 0644);
    if (file < 0) return false;
    const bool whole = write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
    close(file);
    return whole;
}

std::optional<FirstEnd> read_first_end(const std::filesystem::path& run) {
    std::ifstream file(first_end_file(run));
    FirstEnd end;
    std::int64_t code = 0;
    // Programs of other authors may have written it: texts and code are mended as those of a
    // message.
    if (!(file >> code) || !std::getline(file >> std::ws, end.who)) return std::nullopt;
    end.code = received_code(code);
    end.who = received_line(end.who);
    end.what = received_text({std::istreambuf_iterator<char>(file), {}});
    while (!end.what.empty() && end.what.back() == '\n') end.what.pop_back();
    return end;
}

}  // namespace turbidite

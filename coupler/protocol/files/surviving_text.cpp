// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/protocol/files/surviving_text.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstring>

#include "coupler/protocol/files/whole_file.hpp"

namespace turbidite {
namespace {

// The file: this byte when the text is whole, the text, zeros.
constexpr char whole = '\n', in_the_making = '\0';

char* shared_memory(const std::filesystem::path& file, std::size_t size) {
    const int opened = open(file.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
    if (opened < 0) return nullptr;
    // The disk's blocks now: without one, writing to the memory would end the program (SIGBUS).
    const bool there = posix_fallocate(opened, 0, static_cast<off_t>(size)) == 0;
    void* memory = there ? mmap(nullptr, size, PROT_WRITE, MAP_SHARED, opened, 0) : MAP_FAILED;
    close(opened);
    return memory == MAP_FAILED ? nullptr : static_cast<char*>(memory);
}

}  // namespace

SurvivingText::SurvivingText(const std::filesystem::path& file, std::size_t capacity)
    : capacity_(capacity), memory_(shared_memory(file, capacity + 1)) {}

SurvivingText::~SurvivingText() {
    if (memory_) munmap(memory_, capacity_ + 1);
}

void SurvivingText::set(const std::string& text) {
    if (!memory_) return;
    const std::size_t length = std::min(text.size(), capacity_);
    // The fences keep the order: a reader after a SIGKILL sees the memory as this thread left it.
    memory_[0] = in_the_making;
    std::atomic_signal_fence(std::memory_order_seq_cst);
    std::memcpy(memory_ + 1, text.data(), length);
    std::memset(memory_ + 1 + length, 0, capacity_ - length);
    std::atomic_signal_fence(std::memory_order_seq_cst);
    memory_[0] = whole;
}

std::string read_surviving_text(const std::filesystem::path& file) {
    const std::string content = read_whole(file);
    if (content.empty() || content[0] != whole) return "";
    return content.substr(1, content.find('\0', 1) - 1);
}

}  // namespace turbidite

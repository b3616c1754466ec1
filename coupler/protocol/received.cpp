// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/protocol/received.hpp"

#include <boost/locale/utf.hpp>

namespace turbidite {
namespace {

namespace utf = boost::locale::utf;
using Utf8 = utf::utf_traits<char>;

constexpr const char* replacement = "\xef\xbf\xbd";  // U+FFFD

/// C0, DEL and C1: the letters that a terminal may obey.
bool is_control(utf::code_point letter) {
    return letter < 0x20 || (letter >= 0x7f && letter < 0xa0);
}

bool is_layout(utf::code_point letter) {
    return letter == '\n' || letter == '\t';
}

bool is_valid(utf::code_point letter) {
    return letter != utf::illegal && letter != utf::incomplete;
}

std::string mended(const std::string& text, bool one_line) {
    std::string result;
    for (auto at = text.begin(); at != text.end();) {
        auto next = at;
        const utf::code_point letter = Utf8::decode(next, text.end());
        // One byte is replaced, and what follows it is read again: it may be a letter.
        if (!is_valid(letter)) next = at + 1;
        if (one_line && is_layout(letter))
            result += ' ';
        else if (is_valid(letter) && (is_layout(letter) || !is_control(letter)))
            result.append(at, next);
        else
            result += replacement;
        at = next;
    }
    return result;
}

}  // namespace

ExitCode received_code(std::int64_t code) {
    for (const ExitCode known : {ExitCode::handshake_refused, ExitCode::participant_failed,
                                 ExitCode::stalled, ExitCode::physics_refused})
        // 3, 4, 5, 6
        if (code == static_cast<std::int64_t>(known)) return known;
    return ExitCode::participant_failed;
}

std::string received_text(const std::string& text) {
    return mended(text, false);
}

std::string received_line(const std::string& text) {
    return mended(text, true);
}

Hello received(Hello hello) {
    for (std::string* text : {&hello.adapter, &hello.adapter_version, &hello.host_code, &hello.host,
                              &hello.log_file, &hello.case_hash})
        *text = received_line(*text);
    for (auto* list : {&hello.capabilities.shapes, &hello.capabilities.contact_laws})
        for (std::string& text : *list) text = received_line(text);
    return hello;
}

}  // namespace turbidite

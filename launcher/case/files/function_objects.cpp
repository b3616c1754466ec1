// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/files/function_objects.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstring>

#include "coupler/protocol/files/whole_file.hpp"
#include "launcher/case/files/file_names.hpp"

namespace turbidite {
namespace {

namespace fs = std::filesystem;

constexpr int deepest_include = 10;

CaseProblem problem_with_file(const std::string& source, int line, const std::string& fault,
                              const std::string& remedy) {
    return {.source = source,
            .line = line,
            .key = "fluid.functions",
            .value = {},
            .fault = fault,
            .allowed = {},
            .remedy = remedy};
}

bool ends_word(char c) {
    return std::isspace(static_cast<unsigned char>(c)) || std::strchr("{}();\"", c) != nullptr;
}

/// Characters of a file one after the other, with the line they stand in.
class Text {
 public:
    explicit Text(std::string text) : text_(std::move(text)) {}

    bool at_end() const { return at_ >= text_.size(); }
    char now() const { return text_[at_]; }
    bool begins(const char* part) const { return text_.compare(at_, std::strlen(part), part) == 0; }
    int line() const { return line_; }
    std::size_t place() const { return at_; }
    std::string from(std::size_t begin) const { return text_.substr(begin, at_ - begin); }

    void skip(std::size_t count) {
        for (; count > 0 && !at_end(); --count) line_ += text_[at_++] == '\n' ? 1 : 0;
    }

    /// Past the next `end`; false if there is none.
    bool skip_past(const char* end) {
        const std::size_t found = text_.find(end, at_);
        skip((found == std::string::npos ? text_.size() : found + std::strlen(end)) - at_);
        return found != std::string::npos;
    }

    /// Past a string in quotes, in which a backslash protects the next character.
    bool skip_string() {
        skip(1);
        while (!at_end() && now() != '"') skip(now() == '\\' ? 2 : 1);
        const bool closed = !at_end();
        skip(1);
        return closed;
    }

    void skip_blanks() {
        while (!at_end() && (now() == ' ' || now() == '\t')) skip(1);
    }

    std::string word() {
        const std::size_t begin = at_;
        while (!at_end() && !ends_word(now()) && !begins("//") && !begins("/*")) skip(1);
        return from(begin);
    }

 private:
    std::string text_;
    std::size_t at_ = 0;
    int line_ = 1;
};

/// Reads one file of the dictionary; those it includes are read by others.
class Reader {
 public:
    /// `inside`: it is included between braces.
    Reader(const fs::path& file, int depth, bool inside, FunctionObjectsFile& result)
        : folder_(file.parent_path()),
          name_(file.filename().string()),
          depth_(depth),
          inside_(inside),
          in_(read_whole(file)),
          result_(result) {}

    void read() {
        while (!in_.at_end()) part();
        for (const int line : open_) fault(line, "opens a brace that is not closed", "Close it.");
    }

 private:
    /// A comment, a string, verbatim code, a brace, a directive, a word or a blank.
    void part() {
        const std::size_t begin = in_.place();
        const int line = in_.line();
        if (in_.begins("//")) {
            in_.skip_past("\n");
        } else if (in_.begins("/*")) {
            closed(line, in_.skip_past("*/"), "a comment", "*/");
        } else if (in_.begins("#{")) {
            closed(line, in_.skip_past("#}"), "verbatim text", "#}");
        } else if (in_.now() == '"') {
            closed(line, in_.skip_string(), "a string", "a quote");
            last_word_ = in_.from(begin);
        } else if (in_.now() == '#') {
            return directive(begin, line);
        } else if (ends_word(in_.now())) {
            mark(in_.now(), line);
            in_.skip(1);
        } else {
            word(line);
        }
        result_.text += in_.from(begin);
    }

    void mark(char c, int line) {
        if (c == '{') {
            if (!inside_ && open_.empty()) begin_entry(line);
            open_.push_back(line);
        }
        if (c == '}' && open_.empty())
            fault(line, "closes a brace that is not open", "Remove it, or open one before it.");
        if (c == '}' && !open_.empty()) open_.pop_back();
        if (c == ';' || c == '}') last_word_.clear();
    }

    void begin_entry(int line) {
        if (last_word_ == "functions")
            fault(line, "has an entry functions of its own",
                  "The file holds what stands between its braces: remove the word and the braces.");
        else if (last_word_ != "FoamFile")
            result_.names.push_back(last_word_);
    }

    void word(int line) {
        const std::string word = in_.word();
        if (word.empty()) in_.skip(1);  // a slash
        if (last_word_ == "type" && word == "coded") compiled(line, "type coded");
        last_word_ = word;
    }

    void directive(std::size_t begin, int line) {
        const std::string name = in_.word();
        if (name == "#calc" || name == "#codeStream") compiled(line, name);
        const bool must = name == "#include";
        in_.skip_blanks();
        const bool includes = must || name == "#includeIfPresent" || name == "#sinclude";
        const std::size_t quote = in_.place();
        if (!includes || in_.at_end() || in_.now() != '"') return other(begin, name);
        closed(line, in_.skip_string(), "a string", "a quote");
        const std::string quoted = in_.from(quote);
        const std::string path =
            quoted.substr(1, quoted.size() - std::min<std::size_t>(quoted.size(), 2));
        if (path.empty() || std::strchr("/$~<", path.front()) != nullptr) return other(begin, name);
        include(folder_ / path, must, line);
    }

    /// Stays as it is.
    void other(std::size_t begin, const std::string& name) {
        if (name.rfind("#include", 0) == 0 || name == "#sinclude") result_.from_elsewhere = true;
        result_.text += in_.from(begin);
    }

    void include(const fs::path& file, bool must, int line) {
        if (!is_file(file)) {
            if (must)
                fault(line,
                      fmt::format("includes {}, which is not there",
                                  file.lexically_normal().string()),
                      "Paths are relative to the file that includes.");
            return;
        }
        if (depth_ >= deepest_include)
            return fault(line, fmt::format("is included more than {} files deep", deepest_include),
                         "A file must not include itself.");
        Reader(file, depth_ + 1, inside_ || !open_.empty(), result_).read();
    }

    void compiled(int line, const std::string& what) {
        result_.compiled.push_back({name_, line, what});
    }

    void closed(int line, bool is_closed, const char* what, const char* end) {
        if (!is_closed)
            fault(line, fmt::format("begins {} that does not end", what),
                  fmt::format("End it with {}.", end));
    }

    void fault(int line, const std::string& what, const std::string& remedy) {
        result_.problems.push_back(problem_with_file(name_, line, what, remedy));
    }

    fs::path folder_;
    std::string name_;
    int depth_;
    bool inside_;
    Text in_;
    FunctionObjectsFile& result_;
    std::vector<int> open_;  // lines of open braces
    std::string last_word_;
};

}  // namespace

FunctionObjectsFile read_function_objects(const fs::path& file) {
    FunctionObjectsFile result;
    Reader(file, 0, false, result).read();
    if (result.names.empty() && !result.from_elsewhere && result.problems.empty())
        result.problems.push_back(problem_with_file(file.filename().string(), 0,
                                                    "has no function object",
                                                    "Write NAME { type ...; libs (...); }, as "
                                                    "between the braces of OpenFOAM's functions."));
    return result;
}

}  // namespace turbidite

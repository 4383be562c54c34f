#pragma once

#include <string>

namespace gnomon::analysis {

/// A mistake that a case looks like, in a word and in a sentence with the remedy.
struct ImportMistake {
    std::string name;
    std::string sentence;
};

} // namespace gnomon::analysis

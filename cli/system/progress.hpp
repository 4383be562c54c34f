#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>

namespace gnomon::cli {

/// Tells on stderr how far a sweep is: a live line on a terminal, now and then a line elsewhere.
/// Plain text without colours. Any thread may call.
class Progress {
public:
    /// @param total  configurations to compute.
    /// @param known  configurations that were computed before.
    Progress(std::uint64_t total, std::uint64_t known, bool is_quiet);
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    /// Ends the live line.
    ~Progress();

    void begin(const std::string& configuration); ///< what is worked on now
    void add(std::uint64_t done, std::uint64_t failed);

private:
    using Clock = std::chrono::steady_clock;
    void tell(bool is_forced);
    [[nodiscard]] std::string line() const;

    std::uint64_t total_;
    std::uint64_t known_;
    bool is_quiet_;
    bool is_terminal_;
    std::mutex mutex_;
    std::uint64_t done_ = 0;
    std::uint64_t failed_ = 0;
    std::string current_;
    Clock::time_point start_ = Clock::now();
    Clock::time_point told_;
    bool has_line_ = false;
};

} // namespace gnomon::cli

#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>

namespace gnomon::cli {

/// Shows on stderr how far a sweep is: a live line on a terminal, else a line every 5 s. Any thread
/// may call.
class Progress {
public:
    /// @param total  configurations to compute.
    /// @param known  configurations of earlier runs.
    Progress(std::uint64_t total, std::uint64_t known, bool is_quiet);
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    /// Ends the live line.
    ~Progress();

    void begin(const std::string& configuration);
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

/// Shows on stderr the current step of a long command: on a terminal a live line after 2 s, else a
/// line every 30 s.
class SlowWork {
public:
    explicit SlowWork(std::string what);
    SlowWork(const SlowWork&) = delete;
    SlowWork& operator=(const SlowWork&) = delete;
    ~SlowWork(); ///< clears the live line

    void now(std::string what); ///< sets the current step

private:
    using Clock = std::chrono::steady_clock;
    void watch();
    void tell();

    bool is_terminal_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::string what_;
    bool is_done_ = false;
    bool has_line_ = false;
    Clock::time_point start_ = Clock::now();
    std::thread watcher_;
};

} // namespace gnomon::cli

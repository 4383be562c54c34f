#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace gnomon::cli {

/// Says on stderr what a command that has no configurations to count is at, once it has worked for
/// longer than people wait: on a terminal a line that is kept up to date from 2 s on, else a line
/// every 30 s.
class SlowWork {
public:
    explicit SlowWork(std::string what);
    SlowWork(const SlowWork&) = delete;
    SlowWork& operator=(const SlowWork&) = delete;
    ~SlowWork(); ///< clears the live line

    void now(std::string what); ///< what is worked on from now on

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

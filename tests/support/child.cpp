#include "child.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <exception>
#include <stdexcept>

namespace gnomon::store {

namespace {

[[noreturn]] void run(const std::function<void(Child::Ready)>& work, int ready)
{
    int code = 0;
    try {
        work([ready] { [[maybe_unused]] const ssize_t told = ::write(ready, "!", 1); });
    } catch (const std::exception& error) {
        std::fprintf(stderr, "child: %s\n", error.what());
        code = 1;
    }
    ::_exit(code); // without the destructors of the parent's objects
}

} // namespace

Child::Child(const std::function<void(Ready)>& work)
{
    std::array<int, 2> ready{};
    if (::pipe(ready.data()) != 0) {
        throw std::runtime_error("pipe failed");
    }
    pid_ = ::fork();
    if (pid_ == 0) {
        ::close(ready[0]);
        run(work, ready[1]);
    }
    ::close(ready[1]);
    char told = 0;
    [[maybe_unused]] const ssize_t size = ::read(ready[0], &told, 1);
    ::close(ready[0]);
}

Child::~Child()
{
    kill();
}

void Child::kill()
{
    if (pid_ > 0) {
        ::kill(pid_, SIGKILL);
        (void)exit_code();
    }
}

int Child::exit_code()
{
    int status = 0;
    ::waitpid(pid_, &status, 0);
    pid_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

} // namespace gnomon::store

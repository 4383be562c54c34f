#pragma once

#include "cpp/picture.hpp"
#include "cpp/serve.hpp"

#include <functional>
#include <memory>
#include <string_view>

namespace engine {

/// An adapter's main(): reads its options, takes standard output, makes the engine, serves, and
/// says on standard error why it ends early. --rasterizer=system draws with the system's GL;
/// softpipe with Mesa's other rasterizer, to tell what is the engine's from what is the driver's.
/// --mask=shader takes the mask out of the engine's shader; picture makes it of its own pictures.
/// @param name  Begins what is said on standard error.
/// @param make  Makes the engine, once the rasterizer is chosen, with the mask that is asked for.
/// @return  The exit status: 0 at `close` and at the end of input, else 1.
int run(std::string_view name, int argc, char** argv,
        const std::function<std::unique_ptr<Engine>(Mask)>& make);

/// Ends a process, and waits for its end, where a signal ends the adapter. 0: there is none.
void end_process_with_program(int process);

} // namespace engine

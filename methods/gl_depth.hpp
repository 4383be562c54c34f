#pragma once

#include "scene/error.hpp"
#include "scene/settings/job.hpp"

#include <fmt/format.h>

#include <string_view>

namespace gnomon::methods {

/// Refuses a job whose map does not store GL's own depth.
/// @param refusal  `{0}` is the content's name; the arguments follow.
template <typename... Arguments>
void require_gl_depth(const scene::Job& job,
                      fmt::format_string<const std::string_view&, const Arguments&...> refusal,
                      const Arguments&... arguments)
{
    const scene::MapContentTraits& content = traits_of(job.shadow_map.frustum.content);
    if (!content.is_gl_depth()) {
        throw scene::InputError(fmt::format(refusal, content.name, arguments...));
    }
}

} // namespace gnomon::methods

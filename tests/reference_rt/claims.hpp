#pragma once

#include "reference_rt/certificate/certificate.hpp"
#include "scene/pixels/pixel_layers.hpp"

namespace gnomon::reference_rt::test {

/// The claims of a truth, for the certifier.
inline TruthClaims claims_of(const scene::Image<std::uint32_t>& receivers,
                             const scene::Truth& truth, const scene::Image<scene::Vec3f>& position)
{
    TruthClaims claims{receivers, truth.pixel_class, scene::Image<float>{receivers.size(), -1.0F},
                       truth.witness, position};
    for (std::size_t i = 0; i < receivers.pixel_count(); ++i) {
        if (scene::is_scored(truth.pixel_class[i])) {
            claims.truth[i] = truth.pixel_class[i] == scene::PixelClass::lit ? 1.0F : 0.0F;
        }
    }
    return claims;
}

} // namespace gnomon::reference_rt::test

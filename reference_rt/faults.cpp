#include "reference_rt/faults.hpp"

#include "reference_rt/embree_scene.hpp"

#include <memory>

namespace gnomon::reference_rt {

ReferenceScene make_faulty_scene(const scene::TriangleScene& triangles, const Faults& faults)
{
    return ReferenceScene{
        std::make_unique<ReferenceScene::Implementation>(triangles, ReferenceOptions{}, faults)};
}

} // namespace gnomon::reference_rt

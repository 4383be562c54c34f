#pragma once

#include "scene/import/gltf_facts.hpp"
#include "scene/import/stream.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

struct aiNode;
struct aiScene;

namespace gnomon::scene {

/// A node of the flattened tree.
struct PlacedNode {
    const aiNode* node = nullptr;
    Mat4d world_from_node;
};

/// Every node, parents before children, children in order.
[[nodiscard]] std::vector<PlacedNode> placed_nodes(const aiNode& root);

/// The first usable camera, in the order of the nodes.
/// @throws std::runtime_error  if the angle of a glTF camera cannot be determined.
[[nodiscard]] std::optional<ImportedCamera> find_camera(const aiScene& scene,
                                                        const std::vector<PlacedNode>& nodes);

/// How many cameras stand at a node, usable or not.
[[nodiscard]] std::uint64_t count_cameras(const aiScene& scene,
                                          const std::vector<PlacedNode>& nodes);

/// A light of the scene; empty if it cannot have a shadow map.
struct NamedLight {
    std::optional<ImportedLight> light;
    std::string name;
};

/// All lights, in the order of their nodes.
[[nodiscard]] std::vector<NamedLight>
find_lights(const aiScene& scene, const std::vector<PlacedNode>& nodes, const GltfFacts& gltf);

} // namespace gnomon::scene

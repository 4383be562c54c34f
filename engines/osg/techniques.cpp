#include "techniques.hpp"

#include "graph.hpp"

#include <osgShadow/ShadowMap>
#include <osgShadow/SoftShadowMap>

#include <cstdlib>
#include <stdexcept>

namespace engine::osg_adapter {
namespace {

/// The engine's own shader, which keeps all that it does until its colour: that is V, as the
/// surface is white and the ambient bias (0, 1). Positions come through fixed functions, untouched.
std::string tell_more(std::string source)
{
    const std::string colour = "gl_FragColor";
    const std::size_t place = source.find(colour);
    const std::size_t end = source.rfind('}');
    if (place == std::string::npos || source.find(colour, place + 1) != std::string::npos ||
        end < place) {
        throw std::runtime_error{"osgShadow's shader is not the one of OpenSceneGraph 3.6"};
    }
    const std::string unit = std::to_string(position_unit);
    source.insert(end, "gl_FragColor = vec4(gl_TexCoord[" + unit + "].xyz, shaded.x);\n");
    source.replace(place, colour.size(), "vec4 shaded");
    return source;
}

/// A technique that tells more than its colour, and where its map's camera stands.
template <typename Base>
class Telling : public Base {
public:
    [[nodiscard]] osg::Camera* map_camera() const { return this->_camera.get(); }

protected:
    ~Telling() override = default;

    void createShaders() override
    {
        Base::createShaders();
        for (const osg::ref_ptr<osg::Shader>& shader : this->_shaderList) {
            shader->setShaderSource(tell_more(shader->getShaderSource()));
        }
    }
};

template <typename Base>
Technique make_telling(const Json& engine, int resolution, const osg::ref_ptr<Telling<Base>>& made)
{
    const auto texels = static_cast<short>(resolution);
    made->setTextureSize({texels, texels});
    made->setPolygonOffset({engine.at("polygonOffsetFactor").get<float>(),
                            engine.at("polygonOffsetUnits").get<float>()});
    made->setAmbientBias(engine.at("shadows").get<bool>() ? osg::Vec2{0, 1} : osg::Vec2{1, 0});
    return {made, [](const osgShadow::ShadowTechnique& technique) {
                return dynamic_cast<const Telling<Base>&>(technique).map_camera();
            }};
}

} // namespace

std::vector<std::string> technique_names()
{
    return {"ShadowMap", "SoftShadowMap"};
}

Technique make_technique(const Json& engine, int resolution)
{
    if (engine.at("technique") == "ShadowMap") {
        return make_telling<osgShadow::ShadowMap>(engine, resolution,
                                                  new Telling<osgShadow::ShadowMap>);
    }
    const osg::ref_ptr<Telling<osgShadow::SoftShadowMap>> soft =
        new Telling<osgShadow::SoftShadowMap>;
    soft->setSoftnessWidth(engine.at("softnessWidth").get<float>());
    soft->setJitteringScale(engine.at("jitteringScale").get<float>());
    std::srand(1); // the jitter is made of rand(): equal frames need equal numbers
    return make_telling<osgShadow::SoftShadowMap>(engine, resolution, soft);
}

} // namespace engine::osg_adapter

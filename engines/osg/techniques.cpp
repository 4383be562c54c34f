#include "techniques.hpp"

#include "graph.hpp"

#include <osgShadow/ShadowMap>
#include <osgShadow/SoftShadowMap>

#include <cstdlib>
#include <stdexcept>

namespace engine::osg_adapter {
namespace {

/// Makes the engine's shader write position and V. Its colour is V, because the surface is white
/// and the ambient bias (0, 1). The fixed functions pass positions through unchanged.
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

/// A technique that writes position and V, and gives access to its map's camera.
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

void set_up(osgShadow::ShadowMap& technique, const Json& engine, int resolution)
{
    const auto texels = static_cast<short>(resolution);
    technique.setTextureSize({texels, texels});
    technique.setPolygonOffset({engine.at("polygonOffsetFactor").get<float>(),
                                engine.at("polygonOffsetUnits").get<float>()});
    technique.setAmbientBias(engine.at("shadows").get<bool>() ? osg::Vec2{0, 1} : osg::Vec2{1, 0});
}

void set_up_softness(osgShadow::SoftShadowMap& technique, const Json& engine)
{
    technique.setSoftnessWidth(engine.at("softnessWidth").get<float>());
    technique.setJitteringScale(engine.at("jitteringScale").get<float>());
    std::srand(1); // osgShadow jitters with rand(); equal frames need equal numbers
}

template <typename Base>
Technique telling(const osg::ref_ptr<Telling<Base>>& made)
{
    return {made, [](const osgShadow::ShadowTechnique& technique) {
                return dynamic_cast<const Telling<Base>&>(technique).map_camera();
            }};
}

bool is_soft(const Json& engine)
{
    return engine.at("technique") != "ShadowMap";
}

} // namespace

std::vector<std::string> technique_names()
{
    return {"ShadowMap", "SoftShadowMap"};
}

Technique make_technique(const Json& engine, int resolution)
{
    if (!is_soft(engine)) {
        const osg::ref_ptr<Telling<osgShadow::ShadowMap>> hard = new Telling<osgShadow::ShadowMap>;
        set_up(*hard, engine, resolution);
        return telling(hard);
    }
    const osg::ref_ptr<Telling<osgShadow::SoftShadowMap>> soft =
        new Telling<osgShadow::SoftShadowMap>;
    set_up(*soft, engine, resolution);
    set_up_softness(*soft, engine);
    return telling(soft);
}

osg::ref_ptr<osgShadow::ShadowTechnique> make_own_technique(const Json& engine, int resolution)
{
    if (!is_soft(engine)) {
        const osg::ref_ptr<osgShadow::ShadowMap> hard = new osgShadow::ShadowMap;
        set_up(*hard, engine, resolution);
        return hard;
    }
    const osg::ref_ptr<osgShadow::SoftShadowMap> soft = new osgShadow::SoftShadowMap;
    set_up(*soft, engine, resolution);
    set_up_softness(*soft, engine);
    return soft;
}

} // namespace engine::osg_adapter

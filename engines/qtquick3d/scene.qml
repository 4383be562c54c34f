import QtQuick
import QtQuick3D

View3D {
    id: view

    required property bool isPicture
    required property var objects // with geometry, casts, isSeen
    required property real unitsPerMetre
    required property int cullMode

    anchors.fill: parent
    renderMode: View3D.Underlay
    environment: SceneEnvironment {
        antialiasingMode: SceneEnvironment.NoAA
        backgroundMode: SceneEnvironment.Transparent
        tonemapMode: SceneEnvironment.TonemapModeNone
    }

    PerspectiveCamera {
        objectName: "perspective"
    }
    OrthographicCamera {
        objectName: "orthographic"
    }

    DirectionalLight {
        objectName: "directional"
        visible: false
    }
    PointLight {
        objectName: "point"
        visible: false
        quadraticFade: 0
    }
    SpotLight {
        objectName: "spot"
        visible: false
        quadraticFade: 0
    }

    CustomMaterial {
        id: mask
        cullMode: view.cullMode
        vertexShader: "qrc:/place.vert"
        fragmentShader: "qrc:/mask.frag"
    }
    CustomMaterial {
        id: hidden
        cullMode: view.cullMode
        fragmentShader: "qrc:/hidden.frag"
    }
    PrincipledMaterial {
        id: white
        cullMode: view.cullMode
        metalness: 0
        roughness: 1
        specularAmount: 0
    }

    Repeater3D {
        model: view.objects

        Model {
            required property var modelData

            castsShadows: modelData.casts
            geometry: modelData.geometry
            materials: modelData.isSeen ? (view.isPicture ? white : mask) : hidden
            scale: Qt.vector3d(view.unitsPerMetre, view.unitsPerMetre, view.unitsPerMetre)
        }
    }
}

VARYING vec3 place;

void MAIN()
{
}

void AMBIENT_LIGHT()
{
}

void SPECULAR_LIGHT()
{
}

void DIRECTIONAL_LIGHT()
{
    DIFFUSE += vec3(SHADOW_CONTRIB, 1.0, 0.0);
}

void POINT_LIGHT()
{
    DIFFUSE += vec3(SHADOW_CONTRIB, 1.0, 0.0);
}

void SPOT_LIGHT()
{
    DIFFUSE += vec3(SHADOW_CONTRIB, 1.0, 0.0);
}

// Where nothing is seen alpha is 1: what is seen has none above 0. Beyond a spot's cone no light is asked.
void POST_PROCESS()
{
    float visible = DIFFUSE.g > 0.0 ? DIFFUSE.r : 1.0;
    COLOR_SUM = vec4(place, -visible);
}

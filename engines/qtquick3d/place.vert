VARYING vec3 place;

void MAIN()
{
    place = VERTEX;
}

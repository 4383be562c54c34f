void MAIN()
{
}

// What the camera sees, and not what a map does.
void POST_PROCESS()
{
    discard;
}

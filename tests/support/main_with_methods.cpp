// The main function of tests whose jobs name methods and their keys.

#include "methods/handed_keys.hpp"

#include <gmock/gmock.h>

int main(int argc, char** argv)
{
    gnomon::methods::hand_keys_to_scene();
    testing::InitGoogleMock(&argc, argv);
    return RUN_ALL_TESTS();
}

#include "reference_rt/exact/contact.hpp"

#include <gtest/gtest.h>

namespace gnomon::reference_rt {
namespace {

using scene::ClassReason;
using scene::PixelClass;

TEST(ClassifyContact, CrossesWhenTheEdgesAgreeAndTheEndsDiffer)
{
    EXPECT_EQ(classify_contact({{1, 1, 1}, 1, -1}), Contact::cross);
    EXPECT_EQ(classify_contact({{-1, -1, -1}, 1, -1}), Contact::cross);
    EXPECT_EQ(classify_contact({{-1, -1, -1}, -1, 1}), Contact::cross);
}

TEST(ClassifyContact, IsNoneOnOneSideOrBesideTheTriangle)
{
    EXPECT_EQ(classify_contact({{1, 1, 1}, 1, 1}), Contact::none);
    EXPECT_EQ(classify_contact({{1, -1, 1}, 1, -1}), Contact::none);
    EXPECT_EQ(classify_contact({{1, -1, 0}, 1, -1}), Contact::none);
}

TEST(ClassifyContact, IsNoneWhenOnlyAnEndLiesInThePlane)
{
    EXPECT_EQ(classify_contact({{1, 1, 1}, 0, -1}), Contact::none);
    EXPECT_EQ(classify_contact({{1, 1, 1}, 1, 0}), Contact::none);
}

TEST(ClassifyContact, TellsEdgesVerticesAndPlanesApart)
{
    EXPECT_EQ(classify_contact({{1, 0, 1}, 1, -1}), Contact::edge);
    EXPECT_EQ(touched_edge({{1, 0, 1}, 1, -1}), 1);
    EXPECT_EQ(classify_contact({{0, 0, -1}, 1, -1}), Contact::vertex);
    EXPECT_EQ(classify_contact({{0, 0, 0}, 0, 0}), Contact::plane);
}

TEST(IsSeam, NeedsTheApexesOnOppositeSides)
{
    EXPECT_TRUE(is_seam(1, -1));
    EXPECT_FALSE(is_seam(1, 1));
    EXPECT_FALSE(is_seam(0, -1));
}

TEST(ClassifySegment, PrefersAWitnessThenVertexSilhouetteGraze)
{
    SegmentContacts contacts;
    EXPECT_EQ(classify_segment(contacts).pixel_class, PixelClass::lit);
    contacts.runs_in_triangle = true;
    EXPECT_EQ(classify_segment(contacts).reason, ClassReason::graze);
    contacts.touches_edge = true;
    EXPECT_EQ(classify_segment(contacts).reason, ClassReason::silhouette);
    contacts.touches_vertex = true;
    EXPECT_EQ(classify_segment(contacts).reason, ClassReason::vertex);
    EXPECT_EQ(classify_segment(contacts).pixel_class, PixelClass::indeterminate);
    contacts.witness = 7;
    EXPECT_EQ(classify_segment(contacts).pixel_class, PixelClass::blocked);
    EXPECT_EQ(classify_segment(contacts).reason, ClassReason::none);
}

} // namespace
} // namespace gnomon::reference_rt

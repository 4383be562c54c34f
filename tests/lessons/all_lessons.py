"""The five lessons, in the order of docs/lessons.md."""

import game
import lecture
import opengl_notes
import textbook_errors
import webgl

LESSONS = (textbook_errors.LESSON, lecture.LESSON, opengl_notes.LESSON, game.LESSON, webgl.LESSON)


def rows():
    """Pairs of a lesson and a claim."""
    return [(lesson, claim) for lesson in LESSONS for claim in lesson.claims]

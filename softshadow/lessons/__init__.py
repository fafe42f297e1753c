"""What the lessons of the course display: slides beside running code, predictions and answers, reports; their decks.

The lessons themselves are the py:percent files of docs/lessons. `softshadow lessons` copies them.
"""

from softshadow.lessons.clickable import clickable
from softshadow.lessons.code_beside_slide import code_beside_slide
from softshadow.lessons.deck import lesson_slides
from softshadow.lessons.function_check import check_function
from softshadow.lessons.listing_run import listing_difference, run_listing
from softshadow.lessons.prediction import compare_prediction
from softshadow.lessons.program_check import check_program

__all__ = [
    "check_function",
    "check_program",
    "clickable",
    "code_beside_slide",
    "compare_prediction",
    "lesson_slides",
    "listing_difference",
    "run_listing",
]

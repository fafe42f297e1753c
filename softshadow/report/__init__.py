"""Pages to read in a browser, made from records: one run, one failure, the tour, slides.

Pages load nothing from the network: styles and script are in them, and pictures too, or in a folder beside the page.
"""

from softshadow.report.card_choice import CountingCards, counting_cards
from softshadow.report.commands import options_spelled, scene_spelled
from softshadow.report.counting_card import CountingCard
from softshadow.report.cross_section_svg import save_svg, svg_and_words, svg_of
from softshadow.report.cross_sections import CrossSection, cross_section
from softshadow.report.failure_page import FailurePage, write_failure_page
from softshadow.report.page import Section, folder_writer, named, sections
from softshadow.report.run_page import RunPage, write_run_page
from softshadow.report.section_volumes import Crossing
from softshadow.report.slide_deck import Slide, Slides, slides, step_slides
from softshadow.report.tour_page import TourPage, Visit, write_tour_page
from softshadow.report.view3d import View3D, view3d_document, view3d_of

CrossSection._repr_svg_ = svg_and_words  # type: ignore[method-assign]

__all__ = [
    "CountingCard",
    "CountingCards",
    "CrossSection",
    "Crossing",
    "FailurePage",
    "RunPage",
    "Section",
    "Slide",
    "Slides",
    "TourPage",
    "View3D",
    "Visit",
    "counting_cards",
    "cross_section",
    "folder_writer",
    "named",
    "options_spelled",
    "save_svg",
    "scene_spelled",
    "sections",
    "slides",
    "step_slides",
    "svg_of",
    "view3d_document",
    "view3d_of",
    "write_failure_page",
    "write_run_page",
    "write_tour_page",
]

"""All techniques beside the truth of soft shadows: their errors, how fast these fall, and the laws of the penumbra."""

from softshadow.soft.convergence import Convergence, convergence, save_convergence_plot
from softshadow.soft.penumbra_laws import LAWS, Law, LawResult, law_table
from softshadow.soft.technique_errors import (
    TechniqueError,
    compare_techniques,
    contact_sheet_of,
    error_in_time,
    error_of,
    soft_candidates,
)

__all__ = [
    "LAWS",
    "Convergence",
    "Law",
    "LawResult",
    "TechniqueError",
    "compare_techniques",
    "contact_sheet_of",
    "convergence",
    "error_in_time",
    "error_of",
    "law_table",
    "save_convergence_plot",
    "soft_candidates",
]

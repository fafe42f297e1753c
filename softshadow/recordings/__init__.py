"""Programs of others, and one's own: recorded by apitrace or here, and explained as techniques are."""

from softshadow.recordings.recording import Recording, record
from softshadow.recordings.replaying import replay

__all__ = ["Recording", "record", "replay"]

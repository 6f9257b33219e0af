"""Reports: one file per subject, as text for people and as answers for programs."""

"""Questionnaires: their structure as a file, answers as a table, scores and reliability."""

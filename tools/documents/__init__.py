"""Reading, measuring and cross-checking the documents; see tools/check_documents.py."""

"""Why a value is what it is: what each rule contributes, how sensitive it is, and what would change it."""

"""Films of the same visit with one parameter changed: stimuli for people, their key, possible confounds."""
